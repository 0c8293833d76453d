#pragma once

#include <vector>

#include "random_inputs.h"
#include "sdf_ccd/contact/penalty.h"
#include "sdf_ccd/query/shell_query.h"
#include "sdf_ccd/shell/point_shell.h"
#include "sdf_ccd/shell/sample_surface.h"

/// Moving shells against fields, as used by the studies of contact.
namespace sdf_ccd::precision {

/// A shell with its tree.
struct TreeShell {
  PointShell shell;
  SphereTree tree;

  /// @param spacing  [m]; mesh vertices closer together than this are left out too.
  TreeShell(const TriangleMesh& mesh, double spacing);
};

/// A motion of frame P in frame F, within a second.
struct Motion {
  Isometry3d X_FP_start, X_FP_end;
};

/// The distance along u between the centres of field and shell at which the shell comes close to the field's surface:
/// within the field's error and a thousandth of `side` [m].
double touchingDistance(const DistanceField& field, const TreeShell& shell, const Matrix3d& R_FP, const Vector3d& u,
                        double side);

/// Copies of a body pressed into it, from `shallow` to `deep` [m] at the start, that then move by `travel` [m] and
/// rotate by 0.02 rad. All are in contact.
std::vector<Motion> presses(const DistanceField& field, const TreeShell& shell, int count, double shallow, double deep,
                            double travel);

/// Hits on a straight motion from start to end.
struct ContactQuery {
  ContactQuery(const DistanceField& field, const TreeShell& shell, const Motion& motion);

  /// Finds hits.
  void find();
  /// Integrates them.
  const ContactImpulse& integrate(const ContactOptions& options);

  double deepest() const;

  const DistanceField& field;
  const TreeShell& shell;
  ChordPath path;
  std::vector<Isometry3d> X_CF;
  std::vector<SiblingField> siblings;
  ShellQueryResult found;
  std::vector<ShellHit> hits;
  ContactImpulse impulse;
};

}  // namespace sdf_ccd::precision
