#include "duplicate_triangles.h"

#include <algorithm>
#include <tuple>

#include "common/cancel_point.h"
#include "mesh_edges.h"

namespace sdf_ccd {
namespace {

struct Key {
  Vector3i corners;  // ascending
  std::int32_t triangle;
  bool even;  // the triangle's corners are an even permutation of these
};

std::vector<Key> sortedKeys(const TriangleMesh& mesh) {
  std::vector<Key> keys;
  keys.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Vector3i t = mesh.triangles[i];
    const bool even = (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
    std::sort(t.data(), t.data() + 3);
    keys.push_back({t, static_cast<std::int32_t>(i), even});
  }
  CancelTicks<4096> cancel;
  std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    cancel.check();
    return std::tie(a.corners[0], a.corners[1], a.corners[2], a.triangle) <
           std::tie(b.corners[0], b.corners[1], b.corners[2], b.triangle);
  });
  return keys;
}

/// Marks the triangles of `doubled` that lie in walls.
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

DistinctTriangles distinctTriangles(const TriangleMesh& mesh) {
  const std::vector<Key> keys = sortedKeys(mesh);
  std::vector<std::int32_t> copies(mesh.triangles.size(), -1);  // of the first of equal triangles: how many others
  std::vector<char> one_way(mesh.triangles.size(), 0);          // all of them have the same orientation
  bool any_copy = false;
  for (std::size_t i = 0; i < keys.size();) {
    const std::size_t first = i;
    bool same = true;
    for (; i < keys.size() && keys[i].corners == keys[first].corners; ++i)
      same = same && keys[i].even == keys[first].even;
    one_way[keys[first].triangle] = same;
    copies[keys[first].triangle] = static_cast<std::int32_t>(i - first - 1);
    any_copy = any_copy || i - first > 1;
  }
  DistinctTriangles result;
  result.mesh.vertices = mesh.vertices;
  if (!any_copy) {
    result.mesh.triangles = mesh.triangles;
    return result;
  }
  std::vector<char> doubled;
  std::vector<std::int32_t> source;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    if (copies[i] < 0) continue;
    result.mesh.triangles.push_back(mesh.triangles[i]);
    doubled.push_back(copies[i] > 0);
    source.push_back(static_cast<std::int32_t>(i));
    result.copies += copies[i];
    result.copied_area += copies[i] * areaNormal(mesh, static_cast<int>(i)).norm() / 2;
  }
  const std::vector<char> wall = walls(result.mesh, doubled);
  std::vector<Vector3i> shared;
  std::vector<char>& both_ways = result.both_ways;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < wall.size(); ++i) {
    if (wall[i] && one_way[source[i]]) {
      const auto others = static_cast<std::size_t>(copies[source[i]]);
      shared.insert(shared.end(), others, result.mesh.triangles[i]);
      result.copies -= static_cast<int>(others);
      result.copied_area -= static_cast<double>(others) * areaNormal(result.mesh, static_cast<int>(i)).norm() / 2;
      both_ways.push_back(0);
      result.mesh.triangles[kept++] = result.mesh.triangles[i];
    } else if (wall[i]) {
      result.walls.push_back(result.mesh.triangles[i]);
      --result.copies;
      result.copied_area -= areaNormal(result.mesh, static_cast<int>(i)).norm() / 2;
    } else {
      both_ways.push_back(one_way[source[i]] == 0);
      result.mesh.triangles[kept++] = result.mesh.triangles[i];
    }
  }
  result.mesh.triangles.resize(kept);
  result.mesh.triangles.insert(result.mesh.triangles.end(), shared.begin(), shared.end());
  both_ways.resize(result.mesh.triangles.size(), 0);
  return result;
}

}  // namespace sdf_ccd
