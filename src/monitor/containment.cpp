#include "containment.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/cancel_point.h"
#include "mesh/triangle_tree.h"
#include "pose_rounding.h"

namespace sdf_ccd {
namespace {

/// Whether a point is certainly outside the tree's root box; in the tree's frame.
bool isOutsideBox(const BoxTree& tree, const Vector3d& p) {
  const BoxTree::Node& root = tree.node(tree.root().node);
  const Vector3d q = p - tree.origin() - Vector3d(root.center[0][0], root.center[1][0], root.center[2][0]);
  const double rounding = kBoxRounding * (tree.ball().radius + q.norm());
  for (int i = 0; i < 3; ++i) {
    const double along = q.dot(Vector3d(root.axis[i][0][0], root.axis[i][1][0], root.axis[i][2][0]));
    if (std::abs(along) > root.half[i][0] + root.radius[0] + rounding) return true;
  }
  return false;
}

/// Whether a point off the body's surface is certainly outside its solid, frame B. Fields are not asked: in a narrow
/// recess or cavity their errors exceed the gap.
bool isOutsideSolid(const Body& body, const Vector3d& p) {
  if (isOutsideBox(body.triangles->closedTree(), p)) return true;
  return body.doubtful ? body.doubtful->seesOutside(p) : body.triangles->isOutside(p);
}

/// Whether no component of `inner` lies inside `outer`, given that their surfaces are apart.
/// @param attempt  see containmentOf().
/// @param inside   set to a point of `inner` that is certainly inside `outer`, if one is found; frame I.
bool componentsAreOutside(const Body& inner, const Body& outer, const Isometry3d& X_OI, int attempt,
                          std::optional<Vector3d>& inside) {
  const auto is_outside = [&](const std::vector<Vector3d>& corners) {
    const std::size_t count = attempt == 0 ? corners.size() : 1;
    for (std::size_t i = 0; i < count; ++i) {
      checkCancelled();
      const Vector3d& p_I = corners[(attempt + i) % corners.size()];
      const Vector3d p = X_OI * p_I;
      if (isOutsideSolid(outer, p)) return true;
      if (!outer.inside_is_doubtful && outer.triangles->isInside(p)) {
        inside = p_I;
        return false;
      }
    }
    return false;
  };
  const auto& components = inner.triangles->components;
  return std::all_of(components.begin(), components.end(), is_outside);
}

/// Whether a point off the surface of the body is inside it, by more than `margin`; frame B.
bool isDeepInside(const Body& body, const Vector3d& p, double margin, SeparationMemory& memory) {
  if (!body.triangles->isInside(p)) return false;
  SeparationOptions options;
  options.margin = margin;
  options.resolution = 0.1 * margin;
  SeparationWitness witness;
  const ScrewMotion rest(Isometry3d::Identity(), Isometry3d::Identity());
  const BoxTree point({{{p, p, p}, 0.0}});
  const Separation found =
      separation(body.triangles->closedTree(), point, {0.0, 1.0, rest, rest, 0.0}, options, witness, memory);
  return found.state == SeparationState::kApart;
}

/// A point of `inner`'s surface inside `outer`, by more than `margin`: the centre of one of a few triangles that may be
/// there; frame I.
std::optional<Vector3d> pointInside(const Body& inner, const Body& outer, const Isometry3d& X_OI, double margin,
                                    SeparationMemory& memory) {
  constexpr int kMaxPoints = 6;  // some tens of microseconds
  if (outer.inside_is_doubtful || !outer.triangles || !inner.triangles) return {};
  const BoxTree& tree = inner.triangles->tree;
  const Vector3d center_I = X_OI.inverse() * outer.ball.center;
  std::vector<std::int32_t> nodes{tree.root().node};
  for (int points = 0; !nodes.empty();) {
    const BoxTree::Node& node = tree.node(nodes.back());
    nodes.pop_back();
    for (std::int32_t i = 0; i < node.count; ++i) {
      const Vector3d center = tree.origin() + Vector3d(node.center[0][i], node.center[1][i], node.center[2][i]);
      const double reach = outer.ball.radius + double(node.reach[i]) + double(node.radius[i]);
      if ((center - center_I).norm() > reach) continue;
      if (!BoxTree::isTriangle(node.below[i])) {
        nodes.push_back(node.below[i]);
        continue;
      }
      const CornerPointers corners = tree.corners(BoxTree::triangleOf(node.below[i]));
      const Vector3d p_I = (*corners[0] + *corners[1] + *corners[2]) / 3.0, p = X_OI * p_I;
      if (isOutsideBox(outer.triangles->closedTree(), p)) continue;
      checkCancelled();
      if (isDeepInside(outer, p, margin + kPoseEpsilon * (p.norm() + X_OI.translation().norm()), memory)) return p_I;
      if (++points >= kMaxPoints) return {};
    }
  }
  return {};
}

}  // namespace

Containment containmentOf(const Body& f, const Body& p, const Isometry3d& X_FP, int attempt) {
  std::optional<Vector3d> p_P, p_F;
  const bool excluded =
      componentsAreOutside(p, f, X_FP, attempt, p_P) && componentsAreOutside(f, p, X_FP.inverse(), attempt, p_F);
  Containment found{excluded, std::nullopt};
  if (p_P || p_F) found.inside = InsidePoint{p_P.has_value(), p_P ? *p_P : *p_F};
  return found;
}

std::optional<InsidePoint> deepPoint(const Body& f, const Body& p, const Isometry3d& X_FP, double margin,
                                     SeparationMemory& memory) {
  if (const auto p_P = pointInside(p, f, X_FP, margin, memory)) return InsidePoint{true, *p_P};
  if (const auto p_F = pointInside(f, p, X_FP.inverse(), margin, memory)) return InsidePoint{false, *p_F};
  return std::nullopt;
}

}  // namespace sdf_ccd
