#include "sdf_ccd/monitor/scene.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "body/body_builder.h"
#include "body/body_triangles.h"
#include "model/name_pair.h"
#include "model/proofs.h"
#include "surface_needs.h"

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

/// The allowed pairs by their names, the first one of each.
std::map<NamePair, const AllowedPair*> allowedPairs(const SceneDescription& description) {
  std::set<std::string> names;
  for (const BodyDescription& body : description.bodies) {
    if (!names.insert(body.name).second)
      throw std::invalid_argument("scene: two bodies are named \"" + body.name + "\"");
  }
  std::map<NamePair, const AllowedPair*> pairs;
  for (const AllowedPair& pair : description.allowed) {
    if (pair.body_a == pair.body_b)
      throw std::invalid_argument("scene: an allowed pair names \"" + pair.body_a + "\" twice");
    pairs.emplace(namePair(pair.body_a, pair.body_b), &pair);
  }
  return pairs;
}

/// A map's tile that cannot be checked is expected to come later, so what it needs is prepared.
bool isPlanned(const BodyDescription& body) {
  return body.failure.empty() || !body.map.empty();
}

/// The proof about a pair whose bodies are named in the other order.
std::shared_ptr<const PairProof> reversed(const PairProof& proof) {
  PairProof other{proof.ball_b, proof.ball_a, proof.slides, {}};
  if (proof.X_AB) other.X_AB = proof.X_AB->inverse();
  return std::make_shared<const PairProof>(std::move(other));
}

/// A ball about the body's origin that contains it.
BoundingBall ballAbout(const BodyDescription& body) {
  BoundingBall ball;
  for (const GeometryDescription& geometry : body.geometry) {
    const auto* primitive = std::get_if<Primitive>(&geometry.shape);
    const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
    if (mesh && !*mesh) continue;
    const AlignedBox3d box = primitive ? boundingBox(*primitive) : boundingBox(**mesh);
    if (!box.sizes().allFinite()) return {Vector3d::Zero(), std::numeric_limits<double>::infinity()};
    for (int k = 0; k < 8; ++k)
      ball.radius = std::max(ball.radius, (geometry.X_BG * box.corner(AlignedBox3d::CornerType(k))).norm());
  }
  return ball;
}

std::shared_ptr<const PairProof> inSameFrame(const BodyDescription& a, const BodyDescription& b) {
  return std::make_shared<const PairProof>(
      PairProof{ballAbout(a), ballAbout(b), {}, Isometry3d(a.X_frame_B.inverse() * b.X_frame_B)});
}

/// Why the pair is not tested; empty if it is.
LeftOutReason whyLeftOut(const BodyDescription& a, const BodyDescription& b,
                         const std::map<NamePair, const AllowedPair*>& allowed) {
  const auto found = allowed.find(namePair(a.name, b.name));
  if (found != allowed.end()) {
    const AllowedPair& pair = *found->second;
    LeftOutReason reason{pair.reason, pair.depth};
    if (isProof(pair.reason) && pair.proof) reason.proof = pair.body_a == a.name ? pair.proof : reversed(*pair.proof);
    return reason;
  }
  const bool has_tile = !a.map.empty() || !b.map.empty();  // what a map shows comes and goes, wherever its frame is
  if (a.frame == b.frame && !has_tile) return {"in the same frame", 0.0, inSameFrame(a, b)};
  if (!isPlanned(a) || !isPlanned(b)) return {};
  if (a.geometry.empty() || b.geometry.empty()) return {"without collision geometry"};
  return {};
}

/// A body while its pairs are planned.
struct Planned {
  bool is_large = false, has_pair = false, needs_faces = false, may_have_triangles = false, is_half_space = false;
  Extent extent;
};

/// Whether the surface of a is known well enough to decide its pair with b.
bool isSurfaceKnown(const Planned& a, const Planned& b) {
  return a.may_have_triangles || (a.is_half_space && b.may_have_triangles);
}

/// Without a shell of the large body, it would not be noticed wholly inside the small one. So it must be too long for
/// that.
bool isOnlyAField(const Planned& large, const Planned& small) {
  return large.is_large && !small.is_large && large.extent.longest_side > small.extent.diagonal;
}

PlannedPair planPair(int i, int k, const SceneDescription& description, const PlanOptions& options,
                     std::vector<Planned>& planned, std::vector<BodyNeeds>& needs) {
  const BodyDescription &a = description.bodies[i], &b = description.bodies[k];
  Planned &of_a = planned[i], &of_b = planned[k];
  const bool checkable = isPlanned(a) && isPlanned(b);
  const bool a_can = checkable && whyNoShell(a).empty(), b_can = checkable && whyNoShell(b).empty();
  const bool a_faces = a_can && !(b_can && isOnlyAField(of_a, of_b)),
             b_faces = b_can && !(a_can && isOnlyAField(of_b, of_a));
  const bool a_edges = !a_faces && a_can && options.edge_gap > 0.0 && isBox(a);
  const bool b_edges = !b_faces && b_can && options.edge_gap > 0.0 && isBox(b);
  const bool a_shell = a_faces || a_edges, b_shell = b_faces || b_edges;
  of_a.has_pair = of_b.has_pair = true;
  if (!a_shell && !b_shell) return {i, k, false, false};  // not testable
  const bool a_witnesses = b_shell && needsWitnesses(a), b_witnesses = a_shell && needsWitnesses(b);
  if (a_witnesses) needs[i].witnesses = needs[k].field = true;
  if (b_witnesses) needs[k].witnesses = needs[i].field = true;
  const bool a_known = isSurfaceKnown(of_a, of_b), b_known = isSurfaceKnown(of_b, of_a);
  if (checkable && a_known && b_known) needs[i].triangles = needs[k].triangles = true;
  if (a_can && b_can && options.both_fields) needs[i].field = needs[k].field = true;
  if (a_shell) needs[i].shell = needs[k].field = true;
  if (b_shell) needs[k].shell = needs[i].field = true;
  if (!a_known) needs[k].decides = true;
  if (!b_known) needs[i].decides = true;
  of_a.needs_faces |= a_faces;
  of_b.needs_faces |= b_faces;
  return {i, k, a_shell, b_shell, a_edges, b_edges, a_witnesses, b_witnesses};
}

void listLeftOut(const BodyDescription& body, const Planned& planned, const BodyNeeds& needs,
                 std::vector<LeftOut>& left_out) {
  if (!body.failure.empty() || body.geometry.empty()) return;
  std::string no_shell = whyNoShell(body);
  if (no_shell.empty() && planned.is_large && planned.has_pair)
    no_shell = "large; the shells of smaller bodies suffice";
  const std::string idle = planned.has_pair ? "its pairs cannot be checked" : "no pair needs it";
  if (!needs.field) left_out.push_back({"field", body.name, {needs.shell ? "used only as a shell" : idle}});
  if (needs.edges_only) left_out.push_back({"full-shell", body.name, {no_shell}});
  if (!needs.shell) left_out.push_back({"shell", body.name, {no_shell.empty() ? idle : no_shell}});
}

}  // namespace

ScenePlan planScene(const SceneDescription& description, const PlanOptions& options) {
  const std::map<NamePair, const AllowedPair*> allowed = allowedPairs(description);
  const int count = static_cast<int>(description.bodies.size());
  ScenePlan plan;
  plan.needs.assign(count, {false, false, false, false});
  std::vector<Planned> planned(count);
  for (int i = 0; i < count; ++i) {
    const BodyDescription& body = description.bodies[i];
    planned[i].may_have_triangles = mayHaveTriangles(body);
    planned[i].is_half_space = body.geometry.size() == 1 && isHalfSpace(body.geometry.front());
    if (!isPlanned(body)) continue;
    plan.needs[i].field = hidesVoxels(description, body);
    planned[i].is_large = isLarge(body, options);
    planned[i].extent = extentOf(body);
  }
  for (int i = 0; i < count; ++i) {
    for (int k = i + 1; k < count; ++k) {
      const BodyDescription &a = description.bodies[i], &b = description.bodies[k];
      if (a.is_world && b.is_world) continue;
      const LeftOutReason reason = whyLeftOut(a, b, allowed);
      if (reason.text.empty()) {
        plan.pairs.push_back(planPair(i, k, description, options, planned, plan.needs));
      } else {
        plan.left_out.push_back({"pair", pairName(a.name, b.name), reason, i, k});
      }
    }
  }
  for (int i = 0; i < count; ++i) {
    plan.needs[i].edges_only = plan.needs[i].shell && !planned[i].needs_faces;
    listLeftOut(description.bodies[i], planned[i], plan.needs[i], plan.left_out);
  }
  return plan;
}

}  // namespace sdf_ccd
