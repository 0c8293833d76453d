#pragma once

#include <vector>

#include "random_inputs.h"
#include "sdf_ccd/contact/penalty.h"
#include "sdf_ccd/query/shell_query.h"
#include "sdf_ccd/shell/point_shell.h"
#include "sdf_ccd/shell/sample_surface.h"

/// Shells that move against fields, as the studies of contact query them.
namespace sdf_ccd::precision {

/// A shell with its tree.
struct TreeShell {
  PointShell shell;
  SphereTree tree;

  /// @param spacing  [m]; of the mesh's vertices those nearer to each other are left out too.
  TreeShell(const TriangleMesh& mesh, double spacing);
};

/// A motion of frame P in frame F, within a second.
struct Motion {
  Isometry3d X_FP_start, X_FP_end;
};

/// How far from the field's middle the shell's must be, along u, for the shell to come close to the field's surface: to
/// the field's error and a thousandth of `side` [m].
double touchingDistance(const DistanceField& field, const TreeShell& shell, const Matrix3d& R_FP, const Vector3d& u,
                        double side);

/// Copies of a body pressed into it, from `shallow` to `deep` [m] at the start, that move on by `travel` [m] and turn
/// by 0.02 rad. All touch.
std::vector<Motion> presses(const DistanceField& field, const TreeShell& shell, int count, double shallow, double deep,
                            double travel);

/// Straight from the start to the end, and hits on the way.
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
