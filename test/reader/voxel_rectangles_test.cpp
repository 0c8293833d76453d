#include "mesh/voxel_rectangles.h"

#include <array>
#include <map>

#include <gtest/gtest.h>

#include "mesh/reader/voxel_surface.h"
#include "oracle/random.h"

namespace sdf_ccd::voxel_rectangles_test {

constexpr double kSize = 0.5;

using Cells = std::map<std::array<int, 3>, bool>;

TriangleMesh surfaceOf(const Cells& cells) {
  VoxelSurface surface(kSize, 0);
  for (const auto& [cell, occupied] : cells)
    for (int axis = 0; axis < 3; ++axis)
      for (const int upper : {0, 1}) {
        std::array<int, 3> other = cell;
        other[static_cast<std::size_t>(axis)] += 2 * upper - 1;
        if (cells.count(other) == 0) surface.addFace({cell[0], cell[1], cell[2]}, axis, upper == 1);
      }
  return surface.take();
}

/// The faces that a mesh of axis-aligned triangles covers: per axis, side, plane and cell the covered area, in faces.
using Faces = std::map<std::array<int, 5>, double>;

Faces facesOf(const TriangleMesh& mesh) {
  Faces faces;
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]] / kSize, b = mesh.vertices[t[1]] / kSize, c = mesh.vertices[t[2]] / kSize;
    const Vector3d area = 0.5 * (b - a).cross(c - a), low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    int axis = 0;
    area.cwiseAbs().maxCoeff(&axis);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    // Half of the rectangle that the triangle spans, of which the other triangle is the other half.
    for (int i = int(std::lround(low[u])); i < int(std::lround(high[u])); ++i)
      for (int k = int(std::lround(low[v])); k < int(std::lround(high[v])); ++k)
        faces[{axis, area[axis] > 0.0, int(std::lround(low[axis])), i, k}] += 0.5;
  }
  return faces;
}

TEST(VoxelRectangles, CoverTheFacesOfRandomVoxelsOnceWithTheirSides) {
  test::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3i count(1 + int(random() % 70), 1 + int(random() % 5), 1 + int(random() % 5));
    const double share = test::uniform(random, 0.05, 0.95);
    Cells cells = {{{0, 0, 0}, true}, {{count.x() - 1, count.y() - 1, count.z() - 1}, true}};
    for (int x = 0; x < count.x(); ++x)
      for (int y = 0; y < count.y(); ++y)
        for (int z = 0; z < count.z(); ++z)
          if (test::uniform(random, 0.0, 1.0) < share) cells[{x, y, z}] = true;
    const TriangleMesh mesh = surfaceOf(cells);
    const auto voxels = VoxelSolid::of(mesh);
    ASSERT_TRUE(voxels);
    const TriangleMesh rectangles = boundaryRectangles(*voxels);
    EXPECT_EQ(facesOf(rectangles), facesOf(mesh)) << trial;
    EXPECT_LE(rectangles.triangles.size(), mesh.triangles.size());
  }
}

TEST(VoxelRectangles, ABlockHasSix) {
  Cells cells;
  for (int i = 0; i < 60; ++i) cells[{i % 5, i / 5 % 4, i / 20}] = true;
  EXPECT_EQ(boundaryRectangles(*VoxelSolid::of(surfaceOf(cells))).triangles.size(), 12u);
}

TEST(VoxelSolid, FacesOfTwoVoxelsThatAreNotThoseOfOneAreNone) {
  // As many as of one voxel: below and above of one, and the sides of another.
  VoxelSurface surface(kSize, 0);
  for (const bool upper : {false, true}) {
    surface.addFace({0, 0, 0}, 2, upper);
    for (const int axis : {0, 1}) surface.addFace({5, 0, 0}, axis, upper);
  }
  EXPECT_FALSE(VoxelSolid::of(surface.take()));
}

TEST(VoxelSolid, TouchesWhatIsWithinTheSlack) {
  const auto voxels = VoxelSolid::of(surfaceOf({{{2, 0, 0}, true}, {{4, 0, 0}, true}}));
  EXPECT_TRUE(voxels->touches({1.25, 0.25, 0.25}, 0.0));
  EXPECT_FALSE(voxels->touches({1.75, 0.25, 0.25}, 0.2)) << "between the two";
  EXPECT_TRUE(voxels->touches({1.75, 0.25, 0.25}, 0.26));
  EXPECT_FALSE(voxels->touches({0.9, 0.25, 0.25}, 0.09));
  EXPECT_TRUE(voxels->touches({0.9, 0.25, 0.25}, 0.11));
  EXPECT_FALSE(voxels->touches({1e300, 0.25, 0.25}, 0.1));
  EXPECT_FALSE(voxels->touches({std::nan(""), 0.25, 0.25}, 0.1));
}

TEST(VoxelSolid, ContainsWhatHasNoEmptyVoxelWithinTheSlack) {
  const auto voxels = VoxelSolid::of(surfaceOf({{{2, 0, 0}, true}, {{3, 0, 0}, true}}));
  EXPECT_TRUE(voxels->contains({1.25, 0.25, 0.25}, 0.24));
  EXPECT_FALSE(voxels->contains({1.25, 0.25, 0.25}, 0.26));
  EXPECT_TRUE(voxels->contains({1.5, 0.25, 0.25}, 0.1)) << "between the two";
  EXPECT_FALSE(voxels->contains({0.9, 0.25, 0.25}, 0.0));
  EXPECT_FALSE(voxels->contains({1e300, 0.25, 0.25}, 0.1));
  EXPECT_FALSE(voxels->contains({std::nan(""), 0.25, 0.25}, 0.1));
}

}  // namespace sdf_ccd::voxel_rectangles_test
