#include "duplicate_triangles.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "mesh_edges.h"

namespace sdf_ccd {
namespace {

struct Key {
  Vector3i corners;  // ascending
  bool even;         // even permutation of them
  std::int32_t triangle;
};

std::vector<Key> sortedKeys(const TriangleMesh& mesh) {
  std::vector<Key> keys;
  keys.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Vector3i t = mesh.triangles[i];
    bool even = true;
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
      if (t[a] > t[b]) {
        std::swap(t[a], t[b]);
        even = !even;
      }
    }
    keys.push_back({t, even, static_cast<std::int32_t>(i)});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.corners[0], a.corners[1], a.corners[2], a.triangle) <
           std::tie(b.corners[0], b.corners[1], b.corners[2], b.triangle);
  });
  return keys;
}

/// Marks the triangles of `doubled` that lie in walls between solids.
std::vector<char> walls(const TriangleMesh& mesh, const std::vector<char>& doubled) {
  const std::vector<EdgeUse> uses = edgeUses(mesh);
  TriangleSets patches(mesh.triangles.size());
  forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    const EdgeUse* previous = nullptr;
    for (const EdgeUse* use = first; use != last; ++use) {
      if (!doubled[use->triangle]) continue;
      if (previous) patches.join(previous->triangle, use->triangle);
      previous = use;
    }
  });
  std::vector<char> has_border(mesh.triangles.size(), 0), has_free_border(mesh.triangles.size(), 0);
  forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    const auto inside = std::count_if(first, last, [&](const EdgeUse& use) { return doubled[use.triangle] != 0; });
    if (inside != 1) return;
    const EdgeUse* use = std::find_if(first, last, [&](const EdgeUse& u) { return doubled[u.triangle] != 0; });
    const std::int32_t patch = patches.find(use->triangle);
    has_border[patch] = 1;
    if (last - first < 3) has_free_border[patch] = 1;
  });
  std::vector<char> result(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!doubled[i]) continue;
    const std::int32_t patch = patches.find(static_cast<std::int32_t>(i));
    result[i] = has_border[patch] && !has_free_border[patch];
  }
  return result;
}

}  // namespace

TriangleMesh withoutDuplicates(const TriangleMesh& mesh) {
  const std::vector<Key> keys = sortedKeys(mesh);
  std::vector<char> keep(mesh.triangles.size(), 0), faces_both_ways(mesh.triangles.size(), 0);
  bool any_pair = false;
  for (std::size_t i = 0; i < keys.size();) {
    const std::size_t first = i;
    while (i < keys.size() && keys[i].corners == keys[first].corners) {
      if (keys[i].even != keys[first].even) faces_both_ways[keys[first].triangle] = any_pair = true;
      ++i;
    }
    keep[keys[first].triangle] = 1;
  }
  TriangleMesh result;
  result.vertices = mesh.vertices;
  std::vector<char> doubled;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    result.triangles.push_back(mesh.triangles[i]);
    doubled.push_back(faces_both_ways[i]);
  }
  if (!any_pair) return result;
  const std::vector<char> wall = walls(result, doubled);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < wall.size(); ++i) {
    if (!wall[i]) result.triangles[kept++] = result.triangles[i];
  }
  result.triangles.resize(kept);
  return result;
}

}  // namespace sdf_ccd
