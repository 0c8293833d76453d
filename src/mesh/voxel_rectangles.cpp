#include "mesh/voxel_rectangles.h"

#include <algorithm>
#include <tuple>

#include "common/cancel_point.h"

namespace sdf_ccd {
namespace {

using Run = VoxelSolid::Run;

/// A rectangle [u0, u1] × [v0, v1] in a plane across an axis, in voxels from the solid's origin.
struct Rectangle {
  int plane, u0, u1, v0, v1;
};

/// Joins rectangles that are as wide along u and touch along v.
void joinAlongV(std::vector<Rectangle>& rectangles) {
  std::sort(rectangles.begin(), rectangles.end(), [](const Rectangle& a, const Rectangle& b) {
    return std::tie(a.plane, a.u0, a.u1, a.v0) < std::tie(b.plane, b.u0, b.u1, b.v0);
  });
  std::size_t last = 0;
  for (std::size_t i = 1; i < rectangles.size(); ++i) {
    Rectangle& before = rectangles[last];
    const Rectangle& next = rectangles[i];
    if (std::tie(before.plane, before.u0, before.u1, before.v1) == std::tie(next.plane, next.u0, next.u1, next.v0)) {
      before.v1 = next.v1;
    } else {
      rectangles[++last] = next;
    }
  }
  if (!rectangles.empty()) rectangles.resize(last + 1);
}

void swapAxes(std::vector<Rectangle>& rectangles) {
  for (Rectangle& r : rectangles) {
    std::swap(r.u0, r.v0);
    std::swap(r.u1, r.v1);
  }
}

/// Calls visit(begin, end) for what is in `runs` but not in `others`; both in order.
template <class Visit>
void forEachDifference(const std::vector<Run>& runs, const std::vector<Run>& others, const Visit& visit) {
  std::size_t k = 0;
  for (const Run& run : runs) {
    int begin = run.begin;
    while (k < others.size() && others[k].end <= begin) ++k;
    for (std::size_t i = k; i < others.size() && others[i].begin < run.end; ++i) {
      if (begin < others[i].begin) visit(begin, others[i].begin);
      begin = std::max(begin, others[i].end);
    }
    if (begin < run.end) visit(begin, run.end);
  }
}

/// Adds rectangles across `axis`, with normals along it or against it.
void addTo(TriangleMesh& mesh, const std::vector<Rectangle>& rectangles, int axis, int u, int v, bool upper,
           const VoxelSolid& voxels) {
  const bool is_right_handed = (axis + 1) % 3 == u;
  for (const Rectangle& r : rectangles) {
    const int first = static_cast<int>(mesh.vertices.size());
    for (const auto& [x, y] : {std::pair{r.u0, r.v0}, {r.u1, r.v0}, {r.u1, r.v1}, {r.u0, r.v1}}) {
      Vector3d p;
      p[axis] = r.plane;
      p[u] = x;
      p[v] = y;
      mesh.vertices.emplace_back(voxels.origin() + voxels.size() * p);
    }
    const int second = is_right_handed == upper ? first + 1 : first + 3, fourth = 2 * first + 4 - second;
    mesh.triangles.emplace_back(first, second, first + 2);
    mesh.triangles.emplace_back(first, first + 2, fourth);
  }
}

}  // namespace

TriangleMesh boundaryRectangles(const VoxelSolid& voxels) {
  std::vector<Rectangle> sides[3][2];  // per axis: lower, upper
  std::vector<Run> here, beside;
  for (int z = 0; z < voxels.count().z(); ++z) {
    checkCancelled();
    for (int y = 0; y < voxels.count().y(); ++y) {
      voxels.runs(y, z, here);
      for (const Run& run : here) {
        sides[0][0].push_back({run.begin, z, z + 1, y, y + 1});
        sides[0][1].push_back({run.end, z, z + 1, y, y + 1});
      }
      for (const int upper : {0, 1}) {
        voxels.runs(y - 1 + 2 * upper, z, beside);
        forEachDifference(here, beside, [&, upper = upper](int begin, int end) {
          sides[1][upper].push_back({y + upper, begin, end, z, z + 1});
        });
        voxels.runs(y, z - 1 + 2 * upper, beside);
        forEachDifference(here, beside, [&, upper = upper](int begin, int end) {
          sides[2][upper].push_back({z + upper, begin, end, y, y + 1});
        });
      }
    }
  }
  TriangleMesh mesh;
  for (const int upper : {0, 1}) {
    for (auto& side : sides) joinAlongV(side[upper]);
    swapAxes(sides[0][upper]);
    joinAlongV(sides[0][upper]);
    addTo(mesh, sides[0][upper], 0, 1, 2, upper == 1, voxels);
    addTo(mesh, sides[1][upper], 1, 0, 2, upper == 1, voxels);
    addTo(mesh, sides[2][upper], 2, 0, 1, upper == 1, voxels);
  }
  return mesh;
}

}  // namespace sdf_ccd
