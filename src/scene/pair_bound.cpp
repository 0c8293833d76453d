#include "pair_bound.h"

#include <algorithm>

#include "shell/contact_gap.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

bool isPlane(const Body& body) {
  return std::all_of(body.parts.begin(), body.parts.end(), [](const BodyPart& part) {
    return part.field.primitive() && isHalfSpace(*part.field.primitive());
  });
}

double gapToField(const PointShell& shell, const Body& field) {
  return isPlane(field) ? contactGapToPlane(shell) : shell.covering_radius;
}

}  // namespace

double fieldError(const Body& body) {
  double error = 0.0;
  for (const BodyPart& part : body.parts) error = std::max(error, part.field.errorBound());
  return error;
}

ErrorSources contactBound(const Body& a, const Body& b, const PlannedPair& pair) {
  const bool a_to_b = pair.a_shell_b_field && a.shell->size() > 0 && !b.parts.empty();
  const bool b_to_a = pair.b_shell_a_field && b.shell->size() > 0 && !a.parts.empty();
  ErrorSources bound;
  if (a_to_b) bound.field = fieldError(b);
  if (b_to_a) bound.field = std::max(bound.field, fieldError(a));
  if (a_to_b && b_to_a) {
    bound.gap = contactGap(*a.shell, *b.shell);
  } else if (a_to_b || b_to_a) {
    bound.gap = a_to_b ? gapToField(*a.shell, b) : gapToField(*b.shell, a);
  }
  return bound;
}

bool haveSurfaces(const Body& a, const Body& b) {
  const auto isAgainst = [](const Body& f, const Body& p) {
    return p.triangles && p.half_spaces.empty() && (f.triangles || !f.half_spaces.empty());
  };
  return isAgainst(a, b) || isAgainst(b, a);
}

double deviationOf(const Body& a, const Body& b) {
  const auto deviation = [](const Body& body) { return body.triangles ? body.triangles->deviation : 0.0; };
  return deviation(a) + deviation(b);
}

double greatestDepth(const Body& body) {
  if (!body.triangles) return body.ball.radius;
  const BoxTree::Node& root = body.triangles->tree.node(body.triangles->tree.root().node);
  const float half = std::min({root.half[0][0], root.half[1][0], root.half[2][0]});
  return static_cast<double>(half) + static_cast<double>(root.radius[0]) + body.triangles->deviation;
}

double hiddenDepth(const Body& a, const Body& b, const PlannedPair& pair) {
  const auto depth = [](const Body& surface, const Body& solid, bool has_shell) {
    if (!surface.half_spaces.empty()) return 0.0;  // only the other body's depth in it counts
    const PointShell& shell = *surface.shell;
    const bool covers = has_shell && shell.size() > 0 && !solid.parts.empty();
    const double deepest = greatestDepth(solid);
    return covers ? std::min(shell.covering_radius, deepest) : deepest;
  };
  return std::max(depth(a, b, pair.a_shell_b_field), depth(b, a, pair.b_shell_a_field));
}

}  // namespace sdf_ccd
