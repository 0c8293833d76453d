#include "flat_pieces.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "mesh/mesh_edges.h"

namespace sdf_ccd {
namespace {

/// A flat piece has no triangle whose normal is more than 60 degrees from that of the plane, however small its heights.
constexpr double kMinFacing = 0.5;

/// The triangle across each side; -1 unless there is exactly one, with a consistent orientation.
std::vector<Vector3i> neighbours(const TriangleMesh& mesh, const std::vector<EdgeUse>& uses) {
  std::vector<Vector3i> beyond(mesh.triangles.size(), Vector3i::Constant(-1));
  const auto set = [&](const EdgeUse& use, std::int32_t other) {
    const Vector3i& t = mesh.triangles[use.triangle];
    const int from = use.forward ? use.low : use.high;
    for (int side = 0; side < 3; ++side)
      if (t[side] == from) beyond[use.triangle][side] = other;
  };
  forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    if (last - first != 2 || first[0].forward == first[1].forward) return;
    set(first[0], first[1].triangle);
    set(first[1], first[0].triangle);
  });
  return beyond;
}

/// The number of each triangle's piece: pieces grow from the largest triangles over their neighbours.
std::vector<int> growPieces(const TriangleMesh& mesh, const std::vector<Vector3d>& normals,
                            const std::vector<Vector3i>& beyond, double flatness) {
  const std::size_t count = mesh.triangles.size();
  std::vector<double> areas(count);
  for (std::size_t i = 0; i < count; ++i) areas[i] = areaNormal(mesh, static_cast<int>(i)).norm();
  std::vector<int> seeds(count), piece(count, -1), open;
  std::iota(seeds.begin(), seeds.end(), 0);
  std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return areas[a] > areas[b]; });
  for (const int seed : seeds) {
    if (piece[seed] >= 0) continue;
    piece[seed] = seed;
    const Vector3d& normal = normals[seed];
    const Vector3d& point = mesh.vertices[mesh.triangles[seed][0]];
    const auto fits = [&](int triangle) {
      if (normals[triangle].dot(normal) < kMinFacing) return false;
      const Vector3i& t = mesh.triangles[triangle];
      return std::all_of(t.data(), t.data() + 3,
                         [&](int v) { return std::abs(normal.dot(mesh.vertices[v] - point)) <= flatness; });
    };
    for (open.assign(1, seed); !open.empty();) {
      const Vector3i around = beyond[open.back()];
      open.pop_back();
      for (const int next : {around[0], around[1], around[2]}) {
        if (next < 0 || piece[next] >= 0 || !fits(next)) continue;
        piece[next] = seed;
        open.push_back(next);
      }
    }
  }
  return piece;
}

}  // namespace

std::vector<Vector3d> triangleNormals(const TriangleMesh& mesh) {
  std::vector<Vector3d> normals;
  normals.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    normals.push_back(areaNormal(mesh, static_cast<int>(i)).normalized());
  return normals;
}

std::vector<SurfaceEdge> edgesOfFlatPieces(const TriangleMesh& mesh, double flatness) {
  const std::vector<Vector3d> normals = triangleNormals(mesh);
  const std::vector<EdgeUse> uses = edgeUses(mesh);
  const std::vector<int> piece = growPieces(mesh, normals, neighbours(mesh, uses), flatness);
  std::vector<SurfaceEdge> edges;
  forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    const bool inside = last - first == 2 && first[0].forward != first[1].forward &&
                        piece[first[0].triangle] == piece[first[1].triangle];
    if (inside) return;
    Vector3d normal = Vector3d::Zero();
    for (const EdgeUse* use = first; use != last; ++use) normal += normals[use->triangle];
    if (normal.norm() < 1e-6) normal = normals[first->triangle];  // the sides of a sheet cancel
    edges.push_back({mesh.vertices[first->low], mesh.vertices[first->high],
                     normal.isZero() ? Vector3d::UnitZ() : Vector3d(normal.normalized())});
  });
  return edges;
}

}  // namespace sdf_ccd
