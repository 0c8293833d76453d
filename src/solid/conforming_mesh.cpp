#include "conforming_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "common/cancel_point.h"
#include "edge_search.h"
#include "mesh/box_measures.h"
#include "solid/openings/seams.h"

namespace sdf_ccd {
namespace {

using Edge = std::pair<int, int>;  // ascending
using Points = std::vector<int>;   // vertices on a side, in its direction

/// Whether an edge has an odd number of triangles.
bool isOdd(const TriangleMesh& mesh) {
  bool odd = false;
  forEachEdge(edgeUses(mesh), [&](const EdgeUse* first, const EdgeUse* last) { odd = odd || (last - first) % 2 == 1; });
  return odd;
}

/// Edges that are not used equally often in both directions: open ones, and those to which two parts add a side each.
std::vector<Edge> unbalancedEdges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  forEachEdge(edgeUses(mesh), [&](const EdgeUse* first, const EdgeUse* last) {
    if (imbalance(first, last) != 0) edges.emplace_back(first->low, first->high);
  });
  return edges;
}

/// Merges vertices of such edges that are within a distance of each other [m]. None moves by more than twice the
/// distance, lest a row of vertices closes a crack of any width.
/// @return how far vertices moved, at most [m].
double joinVertices(TriangleMesh& mesh, double tolerance) {
  const std::vector<Edge> edges = unbalancedEdges(mesh);
  if (edges.empty()) return 0.0;
  const EdgeSearch search(mesh, edges);
  CancelTicks<256> cancel;
  std::vector<int> joined(mesh.vertices.size()), near;
  std::iota(joined.begin(), joined.end(), 0);
  for (const int vertex : search.vertices()) {
    cancel.check();
    search.find(mesh.vertices[vertex], tolerance, near);
    for (const int i : near) {
      for (const int end : {edges[i].first, edges[i].second}) {
        const Vector3d& p = mesh.vertices[vertex];
        const bool here =
            (mesh.vertices[end] - p).norm() <= tolerance && (mesh.vertices[joined[end]] - p).norm() <= 2.0 * tolerance;
        if (here) joined[vertex] = std::min(joined[vertex], joined[end]);
      }
    }
  }
  for (Vector3i& t : mesh.triangles) t = {joined[t[0]], joined[t[1]], joined[t[2]]};
  double moved = 0.0;
  for (const int vertex : search.vertices()) {
    moved = std::max(moved, (mesh.vertices[joined[vertex]] - mesh.vertices[vertex]).norm());
  }
  return moved;
}

/// Per edge, the vertices on it from its lower end to the higher one.
std::map<Edge, Points> verticesOnEdges(const TriangleMesh& mesh, double tolerance) {
  constexpr std::size_t kMaxPerEdge = 16;  // on average; more are not a tessellation but noise
  const std::vector<Edge> edges = unbalancedEdges(mesh);
  std::map<Edge, Points> on;
  if (edges.empty()) return on;
  const EdgeSearch search(mesh, edges);
  CancelTicks<256> cancel;
  std::vector<int> near;
  std::size_t count = 0;
  for (const int vertex : search.vertices()) {
    cancel.check();
    const Vector3d& p = mesh.vertices[vertex];
    search.find(p, tolerance, near);
    for (const int i : near) {
      const Vector3d &a = mesh.vertices[edges[i].first], &b = mesh.vertices[edges[i].second];
      if ((p - a).norm() <= tolerance || (p - b).norm() <= tolerance) continue;
      on[edges[i]].push_back(vertex);
      if (++count > kMaxPerEdge * edges.size()) return {};
    }
  }
  for (auto& [edge, vertices] : on) sortAlong(mesh, edge, vertices);
  return on;
}

/// Appends the parts of a triangle split at the vertices on its sides; side k runs from corner k to the next one.
void split(const Vector3i& corners, const std::array<Points, 3>& on, std::vector<Vector3i>& parts) {
  for (int k = 0; k < 3; ++k) {
    if (on[k].empty()) continue;
    const auto middle = on[k].begin() + static_cast<std::ptrdiff_t>(on[k].size() / 2);
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    split({corners[last], corners[k], *middle}, {on[last], Points(on[k].begin(), middle), Points()}, parts);
    split({*middle, corners[next], corners[last]}, {Points(middle + 1, on[k].end()), on[next], Points()}, parts);
    return;
  }
  parts.push_back(corners);
}

/// The mesh with vertices merged, and triangles split at vertices on their sides, within a distance [m]; without seams.
/// Other flat triangles stay as they are.
ConformingMesh joinedWithin(const TriangleMesh& original, double tolerance) {
  ConformingMesh result;
  TriangleMesh mesh = original;
  result.moved = joinVertices(mesh, tolerance) + tolerance;  // a side bends to a vertex near it
  result.mesh.vertices = mesh.vertices;
  const Seams seams = findSeams(mesh, tolerance);
  result.moved += seams.farthest;
  TriangleMesh surface;
  surface.vertices = mesh.vertices;
  std::vector<std::int32_t> source;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (seams.is_seam[i]) continue;
    surface.triangles.push_back(seams.is_flat[i] ? original.triangles[i] : mesh.triangles[i]);
    source.push_back(static_cast<std::int32_t>(i));
  }
  const std::map<Edge, Points> on_edges = verticesOnEdges(surface, tolerance);
  std::vector<Vector3i> parts;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Vector3i& t = surface.triangles[i];
    std::array<Points, 3> on;
    for (int k = 0; k < 3; ++k) {
      const int from = t[k], to = t[(k + 1) % 3];
      const auto found = on_edges.find(std::minmax(from, to));
      if (found == on_edges.end()) continue;
      on[k] = found->second;
      if (from > to) std::reverse(on[k].begin(), on[k].end());
    }
    parts.clear();
    split(t, on, parts);
    result.mesh.triangles.insert(result.mesh.triangles.end(), parts.begin(), parts.end());
    result.source.insert(result.source.end(), parts.size(), source[i]);
  }
  return result;
}

}  // namespace

ConformingMesh conformingMesh(const TriangleMesh& mesh) {
  constexpr double kDoubleDigits = 0x1p-48, kFloatDigits = 0x1p-22;  // of the largest coordinate
  constexpr double kMax = 1e-6;                                      // of the mesh's size, far from the origin
  ConformingMesh result{mesh, std::vector<std::int32_t>(mesh.triangles.size()), 0.0};
  std::iota(result.source.begin(), result.source.end(), 0);
  if (unbalancedEdges(mesh).empty()) return result;
  const AlignedBox3d box = boundingBox(mesh);
  for (const double digits : {kDoubleDigits, kFloatDigits}) {
    ConformingMesh next = joinedWithin(mesh, std::min(digits * largestCoordinate(box), kMax * box.sizes().maxCoeff()));
    if (!isOdd(next.mesh)) return next;
  }
  return result;
}

}  // namespace sdf_ccd
