#include "contact_query.h"

#include <algorithm>
#include <stdexcept>

#include "sdf_ccd/field.h"
#include "shell/point_shell.h"

namespace sdf_ccd::precision {
namespace {

ShellOptions optionsOf(double spacing) {
  ShellOptions options;
  options.spacing = spacing;
  options.vertex_spacing = spacing;
  return options;
}

Isometry3d posed(const Matrix3d& R, const Vector3d& middle_F, const Vector3d& middle_P) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = R;
  X.translation() = middle_F - R * middle_P;
  return X;
}

/// Distance [m] along u between the centres of field and shell at which the shell, which comes from 3 `side` away,
/// touches the field's surface first; 0 if it never does.
double touchingDistance(const DistanceField& field, const TreeShell& shell, const Matrix3d& R_FP, const Vector3d& u,
                        double side) {
  const Vector3d middle = field.surfaceBox().center();
  const double from = 3.0 * side;
  ContactQuery approach(field, shell, {posed(R_FP, middle + from * u, middle), posed(R_FP, middle, middle)});
  approach.find();
  double first = 1.0;
  for (const ShellHit& hit : approach.hits) first = std::min(first, hit.interval.enter);
  return (1.0 - first) * from;
}

}  // namespace

TreeShell::TreeShell(const TriangleMesh& mesh, double spacing)
    : shell(sampleSurface(mesh, optionsOf(spacing))), tree(buildSphereTree(shell)) {}

std::vector<Motion> presses(const DistanceField& field, const TreeShell& shell, int count, double shallow, double deep,
                            double travel) {
  const Vector3d middle = field.surfaceBox().center();
  const double side = field.surfaceBox().sizes().maxCoeff();
  Random random(3);
  std::vector<Motion> motions;
  for (int tries = 0; int(motions.size()) < count; ++tries) {
    if (tries > 20 * count) throw std::runtime_error("copies of the body do not touch when pressed together");
    const Matrix3d R = rotation(random);
    const Vector3d u = direction(random);
    const double touching = touchingDistance(field, shell, R, u, side);
    const double pressed = touching - uniform(random, shallow, deep);
    const Isometry3d start = posed(R, middle + pressed * u, middle);
    const Matrix3d R_step = Eigen::AngleAxisd(0.02, direction(random)).toRotationMatrix();
    const Motion motion{start, posed(R_step * R, middle + (pressed - travel) * u, middle)};
    ContactQuery query(field, shell, motion);
    query.find();
    if (!query.hits.empty()) motions.push_back(motion);
  }
  return motions;
}

ContactQuery::ContactQuery(const DistanceField& field, const TreeShell& shell, const Motion& motion)
    : field(field),
      shell(shell),
      path{{{0.0, 1.0, motion.X_FP_start, motion.X_FP_end, 0}}, 0.0},
      X_CF(2, Isometry3d::Identity()) {}

void ContactQuery::find() {
  shellIntervals(field, shell.shell, shell.tree, path, found);
  listHits(found, hits);
}

const ContactImpulse& ContactQuery::integrate(const ContactOptions& options) {
  integrateContact({field, shell.shell, path, X_CF, siblings}, hits, options, {}, impulse);
  return impulse;
}

double ContactQuery::deepest() const {
  double deepest = 0.0;
  for (const HitDepth& depth : impulse.depths) deepest = std::max(deepest, depth.depth);
  return deepest;
}

}  // namespace sdf_ccd::precision
