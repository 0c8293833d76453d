#include "hidden_walls.h"

#include <algorithm>
#include <optional>

#include "common/parallel_for.h"
#include "cut_test.h"
#include "mesh/triangle_tree.h"

namespace sdf_ccd {

std::vector<char> hiddenWalls(const TriangleMesh& mesh, const std::vector<Patch>& patches,
                              const std::vector<Vector3i>& walls) {
  std::vector<char> hidden(walls.size(), 0);
  TriangleMesh closed;  // the closed patches, then the walls, with the mesh's vertices
  closed.vertices = mesh.vertices;
  for (const Patch& patch : patches) {
    if (!patch.closed) continue;
    for (const std::int32_t triangle : patch.triangles) closed.triangles.push_back(mesh.triangles[triangle]);
  }
  if (walls.empty() || closed.triangles.empty() || !(boundingBox(closed).sizes().maxCoeff() > 1e-9)) return hidden;
  const TriangleTree tree(closed);
  std::optional<TriangleTree> all;
  if (closed.triangles.size() < mesh.triangles.size()) all.emplace(mesh);
  const int first = static_cast<int>(closed.triangles.size());
  closed.triangles.insert(closed.triangles.end(), walls.begin(), walls.end());
  const double eps = cutTolerance(closed);
  parallelFor(std::size_t{0}, walls.size(), [&](std::size_t i) {
    const int wall = first + static_cast<int>(i);
    const Corners c = cornersOf(closed, wall);
    const Vector3d center = centroid(c);
    if (!tree.inside(center, TriangleTree::Inside::kNotZero)) return;
    if (all && !all->inside(center, TriangleTree::Inside::kAboveHalf)) return;
    std::vector<int> near;
    tree.trianglesNear(c, eps, near);
    hidden[i] = std::none_of(near.begin(), near.end(), [&](int other) { return cut(closed, wall, other, eps); });
  });
  return hidden;
}

}  // namespace sdf_ccd
