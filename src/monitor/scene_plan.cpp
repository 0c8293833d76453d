#include "sdf_ccd/monitor/scene.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "body/body_builder.h"
#include "model/name_pair.h"
#include "monitor/surface_needs.h"

namespace sdf_ccd {
namespace {

/// Sizes that tell whether one body can lie inside another one [m].
struct Extent {
  double longest_side = 0.0;  ///< of the box around a single primitive; 0 for other bodies
  double diagonal = 0.0;      ///< upper bound of the distance between two points of the body
};

Extent extentOf(const BodyDescription& body) {
  Extent extent;
  AlignedBox3d all;
  for (const GeometryDescription& geometry : body.geometry) {
    const auto* primitive = std::get_if<Primitive>(&geometry.shape);
    const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
    if (mesh && !*mesh) continue;  // building the body will report this failure
    if (geometry.watertight_voxels) return {0.0, std::numeric_limits<double>::infinity()};  // never has a shell
    const AlignedBox3d box = primitive ? boundingBox(*primitive) : boundingBox(**mesh);
    if (!box.sizes().allFinite()) return {0.0, std::numeric_limits<double>::infinity()};
    for (int k = 0; k < 8; ++k) all.extend(geometry.X_BG * box.corner(AlignedBox3d::CornerType(k)));
    if (primitive && body.geometry.size() == 1) extent.longest_side = box.sizes().maxCoeff();
  }
  extent.diagonal = all.isEmpty() ? 0.0 : all.diagonal().norm();
  return extent;
}

/// Whether a body is a single primitive that would need very many points.
bool isLarge(const BodyDescription& body, const PlanOptions& options) {
  if (body.geometry.size() != 1 || options.shell_spacing <= 0.0) return false;
  const auto* primitive = std::get_if<Primitive>(&body.geometry.front().shape);
  if (!primitive || isHalfSpace(body.geometry.front())) return false;
  return surfaceArea(*primitive) / (options.shell_spacing * options.shell_spacing) > options.large_shell_points;
}

bool isBox(const BodyDescription& body) {
  const auto* primitive = std::get_if<Primitive>(&body.geometry.front().shape);
  return primitive && std::holds_alternative<Box>(*primitive);
}

std::map<NamePair, std::string> allowedPairs(const SceneDescription& description) {
  std::set<std::string> names;
  for (const BodyDescription& body : description.bodies) {
    if (!names.insert(body.name).second)
      throw std::invalid_argument("scene: two bodies are named \"" + body.name + "\"");
  }
  std::map<NamePair, std::string> reasons;
  for (const AllowedPair& pair : description.allowed) {
    if (pair.body_a == pair.body_b)
      throw std::invalid_argument("scene: an allowed pair names \"" + pair.body_a + "\" twice");
    reasons.emplace(namePair(pair.body_a, pair.body_b), pair.reason);
  }
  return reasons;
}

/// A map's tile that cannot be checked is expected to come later, so what it needs is prepared.
bool isPlanned(const BodyDescription& body) {
  return body.failure.empty() || !body.map.empty();
}

/// Why the pair is not tested; empty if it is.
std::string whyLeftOut(const BodyDescription& a, const BodyDescription& b,
                       const std::map<NamePair, std::string>& allowed) {
  const auto found = allowed.find(namePair(a.name, b.name));
  if (found != allowed.end()) return found->second;
  if (a.frame == b.frame) return "in the same frame";
  if (!isPlanned(a) || !isPlanned(b)) return {};
  if (a.geometry.empty() || b.geometry.empty()) return "without collision geometry";
  if (!whyNoShell(a).empty() && !whyNoShell(b).empty()) return "neither has a surface that can be sampled";
  return {};
}

}  // namespace

ScenePlan planScene(const SceneDescription& description, const PlanOptions& options) {
  const std::map<NamePair, std::string> allowed = allowedPairs(description);
  const int count = static_cast<int>(description.bodies.size());
  ScenePlan plan;
  plan.needs_field.assign(count, false);
  plan.needs_shell.assign(count, false);
  plan.needs_witnesses.assign(count, false);
  std::vector<bool> needs_faces(count, false);
  std::vector<bool> has_pair(count, false), is_large(count, false);
  std::vector<Extent> extents(count);
  for (int i = 0; i < count; ++i) {
    if (!isPlanned(description.bodies[i])) continue;
    plan.needs_field[i] = hidesVoxels(description, description.bodies[i]);
    is_large[i] = isLarge(description.bodies[i], options);
    extents[i] = extentOf(description.bodies[i]);
  }
  // Without a shell of the large body, it would not be noticed wholly inside the small one. So it must be too long for
  // that.
  const auto isOnlyAField = [&](int large, int small) {
    return is_large[large] && !is_large[small] && extents[large].longest_side > extents[small].diagonal;
  };

  for (int i = 0; i < count; ++i) {
    for (int k = i + 1; k < count; ++k) {
      const BodyDescription& a = description.bodies[i];
      const BodyDescription& b = description.bodies[k];
      if (a.is_world && b.is_world) continue;
      const std::string reason = whyLeftOut(a, b, allowed);
      if (!reason.empty()) {
        plan.left_out.push_back({"pair " + a.name + " - " + b.name, reason, i, k});
        continue;
      }
      const bool checkable = isPlanned(a) && isPlanned(b);
      const bool a_can = checkable && whyNoShell(a).empty(), b_can = checkable && whyNoShell(b).empty();
      const bool a_faces = a_can && !(b_can && isOnlyAField(i, k)), b_faces = b_can && !(a_can && isOnlyAField(k, i));
      const bool a_edges = !a_faces && a_can && options.edge_gap > 0.0 && isBox(a);
      const bool b_edges = !b_faces && b_can && options.edge_gap > 0.0 && isBox(b);
      const bool a_shell = a_faces || a_edges, b_shell = b_faces || b_edges;
      const bool a_witnesses = b_shell && needsWitnesses(a), b_witnesses = a_shell && needsWitnesses(b);
      plan.pairs.push_back({i, k, a_shell, b_shell, a_edges, b_edges, a_witnesses, b_witnesses});
      if (a_witnesses) plan.needs_witnesses[i] = plan.needs_field[k] = true;
      if (b_witnesses) plan.needs_witnesses[k] = plan.needs_field[i] = true;
      if (a_faces) needs_faces[i] = true;
      if (b_faces) needs_faces[k] = true;
      has_pair[i] = has_pair[k] = true;
      if (a_can && b_can && options.both_fields) plan.needs_field[i] = plan.needs_field[k] = true;
      if (a_shell) plan.needs_shell[i] = plan.needs_field[k] = true;
      if (b_shell) plan.needs_shell[k] = plan.needs_field[i] = true;
    }
  }

  for (int i = 0; i < count; ++i) {
    const BodyDescription& body = description.bodies[i];
    plan.edges_only.push_back(plan.needs_shell[i] && !needs_faces[i]);
    if (!body.failure.empty() || body.geometry.empty()) continue;
    std::string no_shell = whyNoShell(body);
    if (no_shell.empty() && is_large[i] && has_pair[i]) no_shell = "large; the shells of smaller bodies suffice";
    const std::string idle = has_pair[i] ? "the others of its pairs cannot be checked" : "no pair needs it";
    if (!plan.needs_field[i])
      plan.left_out.push_back({"field of " + body.name, plan.needs_shell[i] ? "used only as a shell" : idle});
    if (plan.edges_only[i]) plan.left_out.push_back({"full-shell of " + body.name, no_shell});
    if (!plan.needs_shell[i]) plan.left_out.push_back({"shell of " + body.name, no_shell.empty() ? idle : no_shell});
  }
  return plan;
}

}  // namespace sdf_ccd
