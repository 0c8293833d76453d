#include "solid/interior.h"

#include <algorithm>

#include "closed_components.h"

namespace sdf_ccd {
namespace {

using Inside = TriangleTree::Inside;

/// The closed parts of a mesh: those whose winding numbers may be added, as one patch, and the others, each by itself.
struct ClosedParts {
  Patch together;
  std::vector<Patch> apart;
};

ClosedParts closedParts(const TriangleMesh& mesh) {
  TriangleMesh oriented = mesh;
  std::vector<Patch> patches = orientConsistently(oriented);
  std::ptrdiff_t closed = 0;
  for (Patch& patch : patches) {
    // In the orientation of the mesh, not in the one that would close it.
    patch.closed = patch.closed && isClosed(extract(mesh, patch));
    closed += patch.closed;
  }
  std::vector<ClosedComponent> found(patches.size());
  if (closed > 1) found = inspectClosed(normalized(mesh), patches);
  ClosedParts parts;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches[i].closed) continue;
    if (found[i].negative_triangles > 0 &&
        signedVolume(extract(mesh, patches[i])) > 0.0) {  // else it is a cavity, which has to cancel
      parts.apart.push_back(std::move(patches[i]));
      continue;
    }
    std::vector<std::int32_t>& all = parts.together.triangles;
    all.insert(all.end(), patches[i].triangles.begin(), patches[i].triangles.end());
  }
  return parts;
}

}  // namespace

Interior::Interior(const TriangleMesh& mesh, std::shared_ptr<const TriangleTree> tree) : closed_(isClosed(mesh)) {
  const auto add = [&](const Patch& patch) {
    if (patch.triangles.empty()) return;
    groups_.push_back({std::make_shared<const TriangleTree>(extract(mesh, patch)), Inside::kNotZero});
  };
  const ClosedParts parts = closedParts(mesh);
  if (closed_ && parts.apart.empty()) {
    groups_.push_back({std::move(tree), Inside::kNotZero});
    return;
  }
  add(parts.together);
  for (const Patch& patch : parts.apart) add(patch);
  if (!closed_) groups_.push_back({std::move(tree), Inside::kAboveHalf});
}

bool Interior::contains(const Vector3d& p, std::size_t* visited) const {
  return std::any_of(groups_.begin(), groups_.end(),
                     [&](const Group& group) { return group.tree->inside(p, group.rule, visited); });
}

}  // namespace sdf_ccd
