#include "field/voxel_field.h"

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::voxel_field_test {

using namespace test;

constexpr int kSide = VoxelBlock::kSide;
const VoxelLattice kPlace{Vector3d(3.0, -2.0, 0.7), 0.05};

VoxelBlock blockOf(Random& random, int kind) {
  VoxelBlock block;
  for (int z = 0; z < kSide; ++z)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const bool wall = z == 4 || x == 11, ball = Vector3d(x - 9.0, y - 9.0, z - 9.0).norm() < 7.0;
        const bool dust = uniform(random, 0.0, 1.0) < 0.02;
        block.occupied[VoxelBlock::index(x, y, z)] = kind == 0 ? dust : kind == 1 ? wall : kind == 2 ? ball : true;
      }
  return block;
}

/// By brute force over all voxels.
double distanceTo(const VoxelBlock& block, bool occupied, const Vector3d& p) {
  double least = 1e9;
  for (int z = -1; z <= kSide; ++z)
    for (int y = -1; y <= kSide; ++y)
      for (int x = -1; x <= kSide; ++x) {
        const bool inside = std::min({x, y, z}) >= 0 && std::max({x, y, z}) < kSide;
        const bool is_in = inside && block.occupied[VoxelBlock::index(x, y, z)];
        if (is_in != occupied) continue;
        const Vector3d low = kPlace.origin + kPlace.size * Vector3d(x, y, z);
        const AlignedBox3d cube(low, low + Vector3d::Constant(kPlace.size));
        least = std::min(least, cube.exteriorDistance(p));
      }
  return least;
}

double trueDistance(const VoxelBlock& block, const Vector3d& p) {
  const double out = distanceTo(block, true, p);
  return out > 0.0 ? out : -distanceTo(block, false, p);
}

TEST(VoxelField, IsOffByNoMoreThanItSays) {
  Random random(1);
  for (int kind = 0; kind < 4; ++kind) {
    const VoxelBlock block = blockOf(random, kind);
    const auto field = voxelField(block, kPlace, 0.06);
    ASSERT_TRUE(field);
    EXPECT_LT(field->errorBound(), 0.88 * 0.025);
    double worst = 0.0;
    int near = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vector3d p =
          kPlace.origin + Vector3d(uniform(random, -0.1, 1.1), uniform(random, -0.1, 1.1), uniform(random, -0.1, 1.1));
      const double truth = trueDistance(block, p);
      if (std::abs(truth) > 0.06) continue;
      ++near;
      worst = std::max(worst, std::abs(field->sample(p).value - truth));
    }
    EXPECT_GT(near, 100) << kind;
    EXPECT_LE(worst, field->errorBound()) << kind;
    EXPECT_GT(worst, 0.1 * field->errorBound()) << kind;
  }
}

TEST(VoxelField, IsExactAtTheLattice) {
  Random random(2);
  const VoxelBlock block = blockOf(random, 0);
  const auto field = voxelField(block, kPlace, 0.06);
  for (int i = 0; i < 500; ++i) {
    const Vector3d cells(std::floor(uniform(random, 0, 40)), std::floor(uniform(random, 0, 40)),
                         std::floor(uniform(random, 0, 40)));
    const Vector3d p = kPlace.origin + 0.025 * cells;
    const double truth = trueDistance(block, p);
    if (std::abs(truth) >= 0.06) continue;
    EXPECT_NEAR(field->sample(p).value, truth, 1e-4);
  }
}

TEST(VoxelField, NothingOccupiedIsNoField) {
  EXPECT_FALSE(voxelField(VoxelBlock(), kPlace, 0.05));
  EXPECT_TRUE(voxelSurface(VoxelBlock(), kPlace).triangles.empty());
}

TEST(VoxelField, SurfaceIsThatOfTheVoxels) {
  Random random(3);
  for (int kind = 0; kind < 4; ++kind) {
    const VoxelBlock block = blockOf(random, kind);
    const TriangleMesh mesh = voxelSurface(block, kPlace);
    validate(mesh);
    double volume = 0.0;
    for (const Vector3i& t : mesh.triangles)
      volume += (mesh.vertices[t[0]] - kPlace.origin)
                    .dot((mesh.vertices[t[1]] - kPlace.origin).cross(mesh.vertices[t[2]] - kPlace.origin)) /
                6.0;
    EXPECT_NEAR(volume, double(block.occupied.count()) * std::pow(0.05, 3), 1e-9);
  }
}

}  // namespace sdf_ccd::voxel_field_test
