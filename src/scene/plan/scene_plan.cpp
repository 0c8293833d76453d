#include "sdf_ccd/scene.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "scene/body_builder.h"
#include "scene/name_pair.h"
#include "surface_needs.h"

namespace sdf_ccd {
namespace {

/// Sizes that tell whether one body can lie inside another one [m].
struct Extent {
  double longest_side = 0.0;  ///< of the box around a single primitive; 0 for other bodies
  BoundingBall ball;          ///< contains the body; infinite for half-spaces and tiles of maps
};

Extent extentOf(const BodyDescription& body) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (!body.map.empty()) return {0.0, {Vector3d::Zero(), kInfinite}};  // there are many
  Extent extent;
  AlignedBox3d all;
  for (const GeometryDescription& geometry : body.geometry) {
    const auto* primitive = std::get_if<Primitive>(&geometry.shape);
    const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
    if (mesh && !*mesh) continue;  // building the body will report this failure
    const AlignedBox3d box = primitive ? boundingBox(*primitive) : boundingBox(**mesh);
    if (!box.sizes().allFinite()) return {0.0, {Vector3d::Zero(), kInfinite}};
    for (int k = 0; k < 8; ++k) all.extend(geometry.X_BG * box.corner(AlignedBox3d::CornerType(k)));
    if (primitive && body.geometry.size() == 1) extent.longest_side = box.sizes().maxCoeff();
  }
  if (!all.isEmpty()) extent.ball = {all.center(), 0.5 * all.diagonal().norm()};
  return extent;
}

/// Whether a body is a single primitive that would need very many points.
bool isLarge(const BodyDescription& body, const PlanOptions& options) {
  if (body.geometry.size() != 1 || options.shell_spacing <= 0.0) return false;
  const auto* primitive = std::get_if<Primitive>(&body.geometry.front().shape);
  if (!primitive || isHalfSpace(body.geometry.front())) return false;
  return surfaceArea(*primitive) / (options.shell_spacing * options.shell_spacing) > options.large_shell_points;
}

/// The decisions about pairs by their names, the first kind of each.
std::map<NamePair, const PairDecision*> decisionsOf(const SceneDescription& description) {
  std::set<std::string> names;
  for (const BodyDescription& body : description.bodies) {
    if (!names.insert(body.name).second)
      throw std::invalid_argument("scene: two bodies are named \"" + body.name + "\"");
  }
  std::map<NamePair, const PairDecision*> pairs;
  for (const PairDecision& pair : description.allowed) {
    if (pair.body_a == pair.body_b)
      throw std::invalid_argument("scene: an allowed pair names \"" + pair.body_a + "\" twice");
    const PairDecision*& first = pairs.emplace(namePair(pair.body_a, pair.body_b), &pair).first->second;
    if (pair.kind < first->kind) first = &pair;
  }
  return pairs;
}

/// A map's tile that cannot be checked is expected to come later, so what it needs is prepared.
bool isPlanned(const BodyDescription& body) {
  return body.failure.empty() || !body.map.empty();
}

/// A body while its pairs are planned.
struct Planned {
  const BodyDescription* body = nullptr;
  bool is_large = false, has_pair = false, has_half_space = false;
  Extent extent;
};

/// Why the pair is not tested, without its names and indices; none if it is.
std::optional<PairDecision> whyLeftOut(const Planned& of_a, const Planned& of_b,
                                       const std::map<NamePair, const PairDecision*>& allowed) {
  const BodyDescription &a = *of_a.body, &b = *of_b.body;
  const auto known = allowed.find(namePair(a.name, b.name));
  const PairDecision* const given = known == allowed.end() ? nullptr : known->second;
  if (given && given->kind < PairKind::kRigid) return *given;
  const bool has_tile = !a.map.empty() || !b.map.empty();  // what a map shows comes and goes, wherever its frame is
  const auto rigid = [&](const char* text, const Isometry3d& X_AB) {
    auto pose = std::make_shared<const RigidPose>(RigidPose{X_AB, of_a.extent.ball, of_b.extent.ball});
    return PairDecision{"", "", text, PairKind::kRigid, 0.0, std::move(pose)};
  };
  const bool is_with_world = (a.is_attached && b.is_world) || (a.is_world && b.is_attached);
  if (!has_tile && !is_with_world && !a.rigid_root.empty() && a.rigid_root == b.rigid_root)
    return rigid("rigidly joined", (a.X_root_frame * a.X_frame_B).inverse() * b.X_root_frame * b.X_frame_B);
  if (!has_tile && a.frame == b.frame) return rigid("in the same frame", a.X_frame_B.inverse() * b.X_frame_B);
  if (given) return *given;
  if (!isPlanned(a) || !isPlanned(b)) return std::nullopt;
  if (a.geometry.empty() || b.geometry.empty())
    return PairDecision{"", "", "without collision geometry", PairKind::kEmpty};
  return std::nullopt;
}

/// Without a shell of the large body, its contacts with a small one are found in its field alone: it must be too long
/// to lie inside the small one.
bool isOnlyAField(const Planned& large, const Planned& small) {
  return large.is_large && !small.is_large && large.extent.longest_side > 2.0 * small.extent.ball.radius;
}

PlannedPair planPair(int i, int k, const SceneDescription& description, std::vector<Planned>& planned,
                     std::vector<BodyNeeds>& needs) {
  const BodyDescription &a = description.bodies[i], &b = description.bodies[k];
  Planned &of_a = planned[i], &of_b = planned[k];
  of_a.has_pair = of_b.has_pair = true;
  const bool can_be_checked = isPlanned(a) && isPlanned(b) && !(of_a.has_half_space && of_b.has_half_space);
  if (!can_be_checked) return {i, k, false, false};
  needs[i].triangles = needs[k].triangles = true;
  if (a.forces != Forces::kKnown || b.forces != Forces::kKnown) return {i, k, false, false};
  const bool a_can = whyNoShell(a).empty(), b_can = whyNoShell(b).empty();
  const bool a_shell = a_can && !(b_can && isOnlyAField(of_a, of_b)),
             b_shell = b_can && !(a_can && isOnlyAField(of_b, of_a));
  // A field also tells where a body without a shell is.
  if (b_shell || !a_can) needs[i].field = true;
  if (a_shell || !b_can) needs[k].field = true;
  needs[i].shell |= a_shell;
  needs[k].shell |= b_shell;
  return {i, k, a_shell, b_shell};
}

PartState withoutForces(Forces forces) {
  return forces == Forces::kAwaited    ? PartState::kAwaited
         : forces == Forces::kUnwanted ? PartState::kUnwanted
                                       : PartState::kFailed;
}

PartReports partsOf(const BodyDescription& body, const Planned& planned, const BodyNeeds& needs) {
  const PartReport ready{PartState::kReady, ""};
  const auto idle = [](const std::string& why) { return PartReport{PartState::kNotNeeded, why}; };
  if (body.geometry.empty()) return {};
  PartReports parts{ready, ready, ready};
  const std::string no_pair = planned.has_pair ? "its pairs cannot be checked" : "no pair needs it";
  if (!needs.triangles) parts.surface = idle(no_pair);
  const PartReport without = planned.has_pair && body.forces != Forces::kKnown
                                 ? PartReport{withoutForces(body.forces), whyNoForces(body.forces)}
                                 : idle(needs.triangles ? "none of its pairs has forces" : no_pair);
  if (!needs.field) parts.field = needs.shell ? idle("used only as a shell") : without;
  if (needs.shell) return parts;
  const std::string no_shell = whyNoShell(body);
  parts.shell = !no_shell.empty()                      ? idle(no_shell)
                : planned.is_large && planned.has_pair ? idle("large; the shells of smaller bodies suffice")
                                                       : without;
  return parts;
}

}  // namespace

ScenePlan planScene(const SceneDescription& description, const PlanOptions& options) {
  const std::map<NamePair, const PairDecision*> allowed = decisionsOf(description);
  const int count = static_cast<int>(description.bodies.size());
  ScenePlan plan;
  plan.needs.assign(count, {false, false});
  std::vector<Planned> planned(count);
  for (int i = 0; i < count; ++i) {
    const BodyDescription& body = description.bodies[i];
    planned[i].body = &body;
    planned[i].extent = extentOf(body);
    planned[i].has_half_space = std::any_of(body.geometry.begin(), body.geometry.end(),
                                            [](const GeometryDescription& part) { return isHalfSpace(part); });
    if (!isPlanned(body)) continue;
    plan.needs[i].field = hidesVoxels(description, body);
    planned[i].is_large = isLarge(body, options);
  }
  for (int i = 0; i < count; ++i) {
    for (int k = i + 1; k < count; ++k) {
      const BodyDescription &a = description.bodies[i], &b = description.bodies[k];
      if (a.is_world && b.is_world) continue;
      if (std::optional<PairDecision> decision = whyLeftOut(planned[i], planned[k], allowed)) {
        std::tie(decision->body_a, decision->body_b, decision->a, decision->b) = std::tie(a.name, b.name, i, k);
        plan.left_out.push_back(std::move(*decision));
      } else {
        plan.pairs.push_back(planPair(i, k, description, planned, plan.needs));
      }
    }
  }
  for (int i = 0; i < count; ++i) plan.parts.push_back(partsOf(description.bodies[i], planned[i], plan.needs[i]));
  return plan;
}

}  // namespace sdf_ccd
