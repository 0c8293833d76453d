#include "conforming_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>

#include "edge_search.h"
#include "triangle.h"
#include "triangle_cut.h"

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

/// Whether a corner lies on the opposite side, up to the tolerance.
bool isFlat(const TriangleMesh& mesh, std::size_t triangle, double tolerance) {
  const double longest = longestEdge(cornersOf(mesh, static_cast<int>(triangle)));
  return areaNormal(mesh, static_cast<int>(triangle)).norm() <= tolerance * longest;
}

Edge edgeOf(const Vector3i& t, int k) {
  return std::minmax(t[k], t[(k + 1) % 3]);
}

/// Seams: flat triangles that lie on other ones, between whose sides they fill the gap.
///
/// A flat triangle is within the tolerance of its longest side, and of the other two together. So it is near the
/// surface if that side is, or both others are: along edges of other triangles, or sides of seams known already. A
/// needle that sticks out shares no more than one short side with the surface.
struct Seams {
  std::vector<bool> is_flat;  // per triangle
  std::vector<bool> is_seam;  // per triangle; these are flat
  double farthest = 0.0;      // distance from the other triangles, at most [m]
};

class SeamSearch {
 public:
  SeamSearch(const TriangleMesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance) {
    seams_.is_seam.assign(mesh.triangles.size(), false);
    seams_.is_flat.resize(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      seams_.is_flat[i] = isFlat(mesh, i, tolerance);
      if (!seams_.is_flat[i]) continue;
      for (int k = 0; k < 3; ++k) flat_at_[edgeOf(mesh.triangles[i], k)].push_back(i);
    }
  }

  Seams run() {
    if (flat_at_.empty()) return std::move(seams_);
    const std::vector<Edge> edges = otherEdges();
    for (const Edge& edge : edges)
      if (flat_at_.count(edge) > 0) offer(edge, 0.0);
    spread();
    std::optional<EdgeSearch> search;  // the other edges may be divided elsewhere
    for (const auto& [edge, triangles] : flat_at_) {
      const auto is_open = [&](std::size_t triangle) { return !seams_.is_seam[triangle]; };
      if (near_.count(edge) > 0 || std::none_of(triangles.begin(), triangles.end(), is_open)) continue;
      if (!search) search.emplace(mesh_, edges);
      if (liesAlong(edges, *search, edge)) offer(edge, tolerance_);
    }
    spread();
    return std::move(seams_);
  }

 private:
  /// Of triangles that are not flat.
  std::vector<Edge> otherEdges() const {
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      for (int k = 0; k < 3 && !seams_.is_flat[i]; ++k) edges.push_back(edgeOf(mesh_.triangles[i], k));
    return edges;
  }

  /// Records that an edge is near the surface.
  void offer(const Edge& edge, double distance) {
    if (near_.emplace(edge, distance).second) pending_.push_back(edge);
  }

  void spread() {
    CancelTicks<256> cancel;
    for (std::size_t i = 0; i < pending_.size(); ++i) {  // nearest first
      cancel.check();
      for (const std::size_t triangle : flat_at_.at(pending_[i])) test(triangle);
    }
    pending_.clear();
  }

  void test(std::size_t triangle) {
    if (seams_.is_seam[triangle]) return;
    const Vector3i& t = mesh_.triangles[triangle];
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (length(edgeOf(t, k)) > length(edgeOf(t, longest))) longest = k;
    const std::array<Edge, 3> edges = {edgeOf(t, longest), edgeOf(t, (longest + 1) % 3), edgeOf(t, (longest + 2) % 3)};
    const auto at = [&](int k) { return near_.find(edges[k]); };
    double distance = 0.0;
    if (at(0) != near_.end()) {
      distance = at(0)->second + tolerance_;
    } else if (at(1) != near_.end() && at(2) != near_.end()) {
      distance = std::max(at(1)->second, at(2)->second) + tolerance_;
    } else {
      return;
    }
    seams_.is_seam[triangle] = true;
    seams_.farthest = std::max(seams_.farthest, distance);
    for (const Edge& edge : edges) offer(edge, distance);
  }

  /// Whether all of an edge is within the tolerance of these edges: from one to the next, up to the end.
  bool liesAlong(const std::vector<Edge>& edges, const EdgeSearch& search, const Edge& edge) const {
    const Vector3d &a = mesh_.vertices[edge.first], &b = mesh_.vertices[edge.second];
    const auto within = [&](const Vector3d& p, const Vector3d& q) { return (p - q).norm() <= tolerance_; };
    std::vector<int> near;
    Vector3d reached = a;
    while (true) {
      search.find(reached, tolerance_, near);
      Vector3d farthest = reached;
      for (const int i : near) {
        const Vector3d &u = mesh_.vertices[edges[i].first], &v = mesh_.vertices[edges[i].second];
        if (within(b, closestOnSegment(u, v, b))) return true;
        for (const Vector3d& end : {u, v}) {
          const Vector3d on = closestOnSegment(a, b, end);
          if (within(end, on) && (on - a).norm() > (farthest - a).norm()) farthest = on;
        }
      }
      if (farthest == reached) return false;
      reached = farthest;
    }
  }

  double length(const Edge& edge) const { return (mesh_.vertices[edge.first] - mesh_.vertices[edge.second]).norm(); }

  const TriangleMesh& mesh_;
  double tolerance_;
  std::map<Edge, std::vector<std::size_t>> flat_at_;  // flat triangles
  std::map<Edge, double> near_;                       // of these edges, those near the surface: within a distance [m]
  std::vector<Edge> pending_;                         // of these, those whose triangles are yet to be tested
  Seams seams_;
};

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
  const Seams seams = SeamSearch(mesh, tolerance).run();
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
  const double reach = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  for (const double digits : {kDoubleDigits, kFloatDigits}) {
    ConformingMesh next = joinedWithin(mesh, std::min(digits * reach, kMax * box.sizes().maxCoeff()));
    if (!isOdd(next.mesh)) return next;
  }
  return result;
}

}  // namespace sdf_ccd
