#include "seams.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "common/cancel_point.h"
#include "mesh/corners.h"
#include "mesh/triangle.h"
#include "solid/edge_search.h"

namespace sdf_ccd {
namespace {

using Edge = std::pair<int, int>;  // ascending

bool isFlat(const TriangleMesh& mesh, std::size_t triangle, double tolerance) {
  const double longest = longestEdge(cornersOf(mesh, static_cast<int>(triangle)));
  return areaNormal(mesh, static_cast<int>(triangle)).norm() <= tolerance * longest;
}

Edge edgeOf(const Vector3i& t, int k) {
  return std::minmax(t[k], t[(k + 1) % 3]);
}

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
    const CancelPoint cancel;
    for (const auto& [edge, triangles] : flat_at_) {
      cancel.check();
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

}  // namespace

Seams findSeams(const TriangleMesh& mesh, double tolerance) {
  return SeamSearch(mesh, tolerance).run();
}

}  // namespace sdf_ccd
