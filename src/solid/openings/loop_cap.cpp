#include "loop_cap.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "common/cancel_point.h"
#include "common/infinity.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxVertices = 100;  // for the smallest triangulation, whose cost grows with their cube

double areaOf(const std::vector<Vector3d>& vertices, int a, int b, int c) {
  return 0.5 * (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).norm();
}

void addTriangle(const std::vector<Vector3d>& vertices, const Vector3i& t, LoopCap& cap) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;  // where the loop passes a vertex twice
  cap.triangles.push_back(t);
  cap.area += areaOf(vertices, t[0], t[1], t[2]);
}

/// Cuts off ears, the smallest first. Returns the loop that is left.
std::vector<int> shortened(const std::vector<Vector3d>& vertices, const std::vector<int>& loop, LoopCap& cap) {
  const int n = static_cast<int>(loop.size());
  std::vector<int> before(n), after(n);
  for (int i = 0; i < n; ++i) {
    before[i] = (i + n - 1) % n;
    after[i] = (i + 1) % n;
  }
  std::vector<double> size(n);
  std::set<std::pair<double, int>> ears;
  const auto measure = [&](int i) {
    size[i] = areaOf(vertices, loop[before[i]], loop[i], loop[after[i]]);
    ears.emplace(size[i], i);
  };
  for (int i = 0; i < n; ++i) measure(i);
  while (ears.size() > kMaxVertices) {
    const int tip = ears.begin()->second, last = before[tip], next = after[tip];
    ears.erase(ears.begin());
    addTriangle(vertices, {loop[last], loop[tip], loop[next]}, cap);
    after[last] = next;
    before[next] = last;
    for (const int i : {last, next}) {
      ears.erase({size[i], i});
      measure(i);
    }
  }
  std::vector<int> rest;
  const int first = ears.begin()->second;
  for (int i = first; rest.empty() || i != first; i = after[i]) rest.push_back(loop[i]);
  return rest;
}

/// The triangulation of least area: for each part of the loop from i to k, the best corner between, for all i < k.
void triangulate(const std::vector<Vector3d>& vertices, const std::vector<int>& loop, LoopCap& cap) {
  const int n = static_cast<int>(loop.size());
  std::vector<double> least(std::size_t(n) * n, 0.0);
  std::vector<int> corner(std::size_t(n) * n, -1);
  for (int span = 2; span < n; ++span) {
    for (int i = 0; i + span < n; ++i) {
      const int k = i + span;
      double& best = least[i * n + k];
      best = kInfinity;
      for (int j = i + 1; j < k; ++j) {
        const double area = least[i * n + j] + least[j * n + k] + areaOf(vertices, loop[i], loop[j], loop[k]);
        if (area < best) std::tie(best, corner[i * n + k]) = std::tuple(area, j);
      }
    }
  }
  std::vector<std::pair<int, int>> pending = {{0, n - 1}};
  while (!pending.empty()) {
    const auto [i, k] = pending.back();
    pending.pop_back();
    const int j = corner[i * n + k];
    if (j < 0) continue;
    addTriangle(vertices, {loop[i], loop[j], loop[k]}, cap);
    pending.emplace_back(i, j);
    pending.emplace_back(j, k);
  }
}

/// Both loops as one, over a bridge between their closest vertices.
std::vector<int> bridged(const std::vector<Vector3d>& vertices, const std::vector<int>& a, const std::vector<int>& b) {
  std::size_t from = 0, to = 0;
  double least = kInfinity;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      const double distance2 = (vertices[a[i]] - vertices[b[k]]).squaredNorm();
      if (distance2 < least) std::tie(least, from, to) = std::tuple(distance2, i, k);
    }
  }
  std::vector<int> loop;
  for (std::size_t i = 0; i <= a.size(); ++i) loop.push_back(a[(from + i) % a.size()]);
  for (std::size_t k = 0; k <= b.size(); ++k) loop.push_back(b[(to + k) % b.size()]);
  return loop;
}

}  // namespace

LoopCap capLoop(const std::vector<Vector3d>& vertices, const std::vector<int>& loop) {
  checkCancelled();
  LoopCap cap;
  triangulate(vertices, loop.size() > kMaxVertices ? shortened(vertices, loop, cap) : loop, cap);
  return cap;
}

std::vector<LoopCap> capLoops(const std::vector<Vector3d>& vertices, const std::vector<std::vector<int>>& loops) {
  std::vector<LoopCap> caps;
  for (const std::vector<int>& loop : loops) caps.push_back(capLoop(vertices, loop));
  // Only the largest openings matter, and trying all pairs of many would take long.
  constexpr std::size_t kMaxLoops = 12, kLongestLoop = 1000;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].size() <= kLongestLoop) order.push_back(i);
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t k) { return std::pair(-caps[i].area, i) < std::pair(-caps[k].area, k); });
  order.resize(std::min(order.size(), kMaxLoops));
  std::vector<char> done(loops.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (done[order[i]]) continue;
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      LoopCap &first = caps[order[i]], &second = caps[order[k]];
      if (done[order[k]]) continue;
      LoopCap both = capLoop(vertices, bridged(vertices, loops[order[i]], loops[order[k]]));
      constexpr double kClearlyLess = 0.9;
      if (both.area > kClearlyLess * (first.area + second.area)) continue;
      first = std::move(both);
      second = {};
      done[order[k]] = 1;
      break;
    }
  }
  return caps;
}

}  // namespace sdf_ccd
