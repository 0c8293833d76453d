#include "rim.h"

#include <algorithm>
#include <cmath>

#include "common/cancel_point.h"
#include "mesh/mesh_edges.h"
#include "solid/edge_search.h"

namespace sdf_ccd {
namespace {

EdgeSearch searchOf(const TriangleMesh& mesh, const std::vector<std::pair<std::pair<int, int>, int>>& edges) {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [edge, n] : edges) pairs.push_back(edge);
  return EdgeSearch(mesh, pairs);
}

}  // namespace

Rim::Rim(const TriangleMesh& mesh) : mesh_(mesh) {
  forEachEdge(edgeUses(mesh), [&](const EdgeUse* first, const EdgeUse* last) {
    const int n = imbalance(first, last);
    if (n != 0) edges_.emplace(Edge(first->low, first->high), -n);
  });
}

void Rim::add(int from, int to, int n) {
  if (from == to || n == 0) return;
  const bool up = from < to;
  const auto position = edges_.try_emplace(up ? Edge(from, to) : Edge(to, from), 0).first;
  position->second += up ? n : -n;
  if (position->second == 0) edges_.erase(position);
}

void Rim::fill(int a, int b, int c, int n) {
  if (a == b || b == c || c == a) return;  // its boundary cancels
  for (int i = 0; i < std::abs(n); ++i) triangles_.push_back(n > 0 ? Vector3i(a, b, c) : Vector3i(a, c, b));
  add(a, b, -n);
  add(b, c, -n);
  add(c, a, -n);
}

void Rim::join(double tolerance) {
  if (!empty()) mergeVertices(tolerance);
  if (!empty()) splitEdges(tolerance);
}

void Rim::mergeVertices(double tolerance) {
  const std::vector<std::pair<Edge, int>> before = edges();
  const EdgeSearch search = searchOf(mesh_, before);
  std::map<int, int> target;  // vertices that are kept map to themselves, and are more than the tolerance apart
  std::vector<int> near;
  bool any = false;
  const CancelPoint cancel;
  for (const int vertex : search.vertices()) {
    cancel.check();
    const Vector3d& p = mesh_.vertices[vertex];
    search.find(p, tolerance, near);
    int nearest = vertex;
    double least = tolerance;
    for (const int i : near) {
      for (const int other : {before[i].first.first, before[i].first.second}) {
        const auto known = target.find(other);
        const double distance = (mesh_.vertices[other] - p).norm();
        if (known == target.end() || known->second != other || distance > least) continue;
        if (distance == least && nearest != vertex && other > nearest) continue;
        nearest = other;
        least = distance;
      }
    }
    target[vertex] = nearest;
    any |= nearest != vertex;
  }
  if (!any) return;
  for (const auto& [edge, n] : before) {
    const auto [a, b] = edge;
    // a→b becomes a→b', then a'→b'. What is left between old and new vertices cancels over the whole loop.
    fill(a, b, target[b], n);
    fill(a, target[b], target[a], n);
  }
}

void Rim::splitEdges(double tolerance) {
  const std::vector<std::pair<Edge, int>> before = edges();
  const EdgeSearch search = searchOf(mesh_, before);
  std::vector<std::vector<int>> through(before.size());
  std::vector<int> near;
  const CancelPoint cancel;
  for (const int vertex : search.vertices()) {
    cancel.check();
    search.find(mesh_.vertices[vertex], 0.5 * tolerance, near);
    for (const int i : near) {
      if (vertex != before[i].first.first && vertex != before[i].first.second) through[i].push_back(vertex);
    }
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto& [edge, n] = before[i];
    if (through[i].empty()) continue;
    sortAlong(mesh_, edge, through[i]);
    int last = edge.first;
    for (const int vertex : through[i]) {
      fill(last, edge.second, vertex, n);  // last→end becomes last→vertex→end
      last = vertex;
    }
  }
}

std::vector<std::vector<int>> Rim::takeLoops() {
  std::map<int, std::vector<int>> next;  // per vertex, where edges run to
  for (const auto& [edge, n] : edges_) {
    const auto [from, to] = n > 0 ? edge : Edge(edge.second, edge.first);
    next[from].insert(next[from].end(), std::abs(n), to);
  }
  edges_.clear();
  std::vector<std::vector<int>> loops;
  for (auto& [start, first] : next) {
    std::vector<int> path;
    std::map<int, std::size_t> position;  // index in `path`
    int at = start;
    while (!next[at].empty() || !path.empty()) {
      const auto [seen, is_new] = position.try_emplace(at, path.size());
      if (!is_new) {
        const std::size_t begin = seen->second;
        loops.emplace_back(path.begin() + std::ptrdiff_t(begin), path.end());
        for (std::size_t i = begin; i < path.size(); ++i) position.erase(path[i]);
        path.resize(begin);
        if (path.empty() && next[at].empty()) break;
        continue;
      }
      path.push_back(at);
      const int to = next[at].back();
      next[at].pop_back();
      at = to;
    }
  }
  return loops;
}

}  // namespace sdf_ccd
