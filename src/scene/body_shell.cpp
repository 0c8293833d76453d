#include "body_shell.h"

#include <algorithm>

#include "common/cancel_point.h"
#include "shell/contact_gap.h"
#include "shell/point_shell.h"
#include "shell/sampled_points.h"

namespace sdf_ccd {
namespace {

/// Lower bound of the depth of a point inside other parts; negative if it may be outside of all of them [m].
double knownDepth(const std::vector<ShellPart>& parts, std::size_t own, const Vector3d& p_B) {
  double depth = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i == own || !parts[i].field) continue;
    const Vector3d p_G = parts[i].X_BG.inverse() * p_B;
    if (!parts[i].field->surfaceBox().contains(p_G)) continue;
    const FieldSample sample = parts[i].field->sample(p_G);
    depth = std::max(depth, -(sample.value + sample.error));
  }
  return depth;
}

/// Sets the radii of the union. A part whose points cover it as densely as edges are sampled consists of edges, and is
/// flat: contact with it is within its covering radius of a point, plus the flatness of the other body only, whereas
/// contactGap() adds twice the flatness of both.
void setRadii(const std::vector<ShellPart>& parts, SampledPoints& all) {
  double covering = 0.0;
  all.edge_radius = 0.0;
  for (const ShellPart& part : parts) {
    const PointShell& shell = part.shell;
    all.covering_radius = std::max(all.covering_radius, shell.covering_radius);
    if (shell.covering_radius <= contactGap(shell, shell)) {
      covering = std::max(covering, shell.covering_radius);
    } else {
      all.edge_radius = std::max(all.edge_radius, shell.edge_radius);
      all.flatness = std::max(all.flatness, shell.flatness);
    }
  }
  all.edge_radius = std::max(all.edge_radius, covering - 2.0 * all.flatness);
}

}  // namespace

PointShell unionShell(const std::vector<ShellPart>& parts) {
  const CancelPoint cancel;
  SampledPoints all;
  setRadii(parts, all);
  double part_error = 0.0;
  for (std::size_t own = 0; own < parts.size(); ++own) {
    const PointShell& shell = parts[own].shell;
    part_error = std::max(part_error, shell.position_error);
    for (std::size_t i = 0; i < shell.size(); ++i) {
      cancel.check();
      const Vector3d p_B = parts[own].X_BG * shell.point(i);
      const double depth = knownDepth(parts, own, p_B);
      if (depth > shell.covering_radius) continue;
      all.points.push_back(p_B);
      all.normals.emplace_back((parts[own].X_BG.linear() * shell.normal(i)).cast<float>());
      all.areas.push_back(depth > shell.position_error ? 0.0F : shell.areas[i]);
    }
  }
  // About its own origin, a part that is alone is not rounded again, unless it is rotated.
  PointShell shell = parts.size() == 1 ? toShell(all, parts[0].X_BG * parts[0].shell.origin) : toShell(all);
  shell.position_error += part_error;
  return shell;
}

std::size_t bytesOf(const PointShell& shell, const SphereTree& tree) {
  return shell.size() * PointShell::kBytesPerPoint + tree.nodes.size() * sizeof(SphereTree::Node);
}

BoundingBall boundingBall(const PointShell& shell) {
  AlignedBox3d box;
  const std::vector<Vector3d> points = shell.points();
  for (const Vector3d& p : points) box.extend(p);
  BoundingBall ball;
  if (box.isEmpty()) return ball;
  ball.center = box.center();
  for (const Vector3d& p : points) ball.radius = std::max(ball.radius, (p - ball.center).norm());
  return ball;
}

}  // namespace sdf_ccd
