#include "mesh_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "common/cancel_point.h"

namespace sdf_ccd {
namespace {

struct Neighbour {
  std::int32_t triangle = -1;
  bool agrees = true;
};

/// The neighbours over the three sides of every triangle, where the edge has exactly two triangles.
std::vector<std::array<Neighbour, 3>> neighbours(const TriangleMesh& mesh, const std::vector<EdgeUse>& uses) {
  std::vector<std::array<Neighbour, 3>> result(mesh.triangles.size());
  std::vector<char> filled(mesh.triangles.size(), 0);
  forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    if (last - first != 2) return;
    const EdgeUse &a = first[0], &b = first[1];
    const bool agrees = a.forward != b.forward;
    result[a.triangle][filled[a.triangle]++] = {b.triangle, agrees};
    result[b.triangle][filled[b.triangle]++] = {a.triangle, agrees};
  });
  return result;
}

/// Connected sets of triangles.
struct FlippedSets {
  std::vector<std::int32_t> label;  ///< of each triangle
  std::vector<char> mixed;          ///< per label, whether some of its triangles were flipped, but not all
};

/// Flips triangles until those of each set agree.
FlippedSets flipBySets(TriangleMesh& mesh, const std::vector<EdgeUse>& uses) {
  const auto adjacent = neighbours(mesh, uses);
  std::vector<std::int32_t> label(mesh.triangles.size(), -1);
  std::vector<char> flipped(mesh.triangles.size(), 0), mixed;
  std::vector<std::int32_t> set;
  std::int32_t sets = 0;
  CancelTicks<4096> cancel;
  for (std::size_t seed = 0; seed < label.size(); ++seed) {
    if (label[seed] >= 0) continue;
    set.assign(1, static_cast<std::int32_t>(seed));
    label[seed] = sets;
    double area = 0, flipped_area = 0;
    for (std::size_t next = 0; next < set.size(); ++next) {
      cancel.check();
      const std::int32_t triangle = set[next];
      const double weight = areaNormal(mesh, triangle).norm();
      area += weight;
      if (flipped[triangle]) flipped_area += weight;
      for (const Neighbour& neighbour : adjacent[triangle]) {
        if (neighbour.triangle < 0 || label[neighbour.triangle] >= 0) continue;
        label[neighbour.triangle] = sets;
        flipped[neighbour.triangle] = flipped[triangle] != !neighbour.agrees;
        set.push_back(neighbour.triangle);
      }
    }
    const bool keep_flipped = flipped_area <= area / 2;
    for (const std::int32_t triangle : set) {
      if ((flipped[triangle] != 0) == keep_flipped) std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
    }
    mixed.push_back(std::any_of(set.begin(), set.end(), [&](auto triangle) { return flipped[triangle] != 0; }));
    ++sets;
  }
  return {std::move(label), std::move(mixed)};
}

/// Whether all edges of a label are balanced, per label. `uses` must be of the mesh in its current state.
std::vector<char> balanced(const std::vector<EdgeUse>& uses, const std::vector<std::int32_t>& label) {
  std::vector<char> result(label.size(), 1);
  std::map<std::int32_t, int> balance;
  forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    balance.clear();
    for (const EdgeUse* use = first; use != last; ++use) balance[label[use->triangle]] += use->forward ? 1 : -1;
    for (const auto& [set, sum] : balance) {
      if (sum != 0) result[set] = 0;
    }
  });
  return result;
}

}  // namespace

std::vector<Patch> orientConsistently(TriangleMesh& mesh) {
  const FlippedSets flipped = flipBySets(mesh, edgeUses(mesh));
  const std::vector<std::int32_t>& label = flipped.label;
  const std::vector<EdgeUse> uses = edgeUses(mesh);
  const std::vector<char> closed_alone = balanced(uses, label);

  TriangleSets sets(mesh.triangles.size());
  forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    const EdgeUse* previous_open = nullptr;
    for (const EdgeUse* use = first; use != last; ++use) {
      if (closed_alone[label[use->triangle]]) continue;
      if (previous_open) sets.join(previous_open->triangle, use->triangle);
      previous_open = use;
    }
  });
  std::vector<std::int32_t> first_of_label(label.size(), -1), patch_label(label.size());
  for (std::size_t i = 0; i < label.size(); ++i) {
    const auto triangle = static_cast<std::int32_t>(i);
    if (closed_alone[label[i]]) {
      if (first_of_label[label[i]] < 0) first_of_label[label[i]] = triangle;
      sets.join(first_of_label[label[i]], triangle);
    }
    patch_label[i] = sets.find(triangle);
  }
  const std::vector<char> closed = balanced(uses, patch_label);

  std::vector<Patch> patches;
  std::vector<std::int32_t> index_of_union(label.size(), -1), index_of_set(label.size(), -1);
  for (std::size_t i = 0; i < label.size(); ++i) {
    const bool is_closed = closed[patch_label[i]] != 0;
    std::int32_t& index = is_closed ? index_of_union[patch_label[i]] : index_of_set[label[i]];
    if (index < 0) {
      index = static_cast<std::int32_t>(patches.size());
      patches.push_back({{}, is_closed});
    }
    patches[index].triangles.push_back(static_cast<std::int32_t>(i));
    patches[index].mixed = patches[index].mixed || flipped.mixed[label[i]] != 0;
  }
  return patches;
}

TriangleMesh extract(const TriangleMesh& mesh, const Patch& patch) {
  TriangleMesh part;
  part.triangles.reserve(patch.triangles.size());
  std::unordered_map<std::int32_t, std::int32_t> vertices;
  CancelTicks<4096> cancel;
  for (const std::int32_t triangle : patch.triangles) {
    cancel.check();
    Vector3i corners;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t vertex = mesh.triangles[triangle][i];
      const auto [entry, is_new] = vertices.try_emplace(vertex, static_cast<std::int32_t>(part.vertices.size()));
      if (is_new) part.vertices.push_back(mesh.vertices[vertex]);
      corners[i] = entry->second;
    }
    part.triangles.push_back(corners);
  }
  return part;
}

void flip(TriangleMesh& mesh, const Patch& patch) {
  for (const std::int32_t triangle : patch.triangles) {
    std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
  }
}

TriangleMesh normalized(TriangleMesh mesh) {
  const AlignedBox3d box = boundingBox(mesh);
  int exponent = 0;
  std::frexp(box.sizes().maxCoeff(), &exponent);
  for (Vector3d& v : mesh.vertices) v = std::ldexp(1.0, -exponent) * (v - box.center());
  return mesh;
}

}  // namespace sdf_ccd
