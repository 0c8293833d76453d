#pragma once

#include <vector>

#include "contact/penalty.h"
#include "query/shell_query.h"
#include "random_inputs.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"

/// Moving shells against fields, for the studies of contact.
namespace sdf_ccd::precision {

/// A point shell with its sphere tree.
struct TreeShell {
  PointShell shell;
  SphereTree tree;

  /// @param spacing  point spacing [m]; of mesh vertices closer together than this, some are left out too.
  TreeShell(const TriangleMesh& mesh, double spacing);
};

/// A motion of frame P in frame F, within a second.
struct Motion {
  Isometry3d X_FP_start, X_FP_end;
};

/// Random motions of copies of a body that start between `shallow` and `deep` [m] deep in it, move deeper by `travel`
/// [m] and rotate by 0.02 rad. All have contact.
std::vector<Motion> presses(const DistanceField& field, const TreeShell& shell, int count, double shallow, double deep,
                            double travel);

/// The shell query and contact impulse of one motion, taken as a single chord.
struct ContactQuery {
  ContactQuery(const DistanceField& field, const TreeShell& shell, const Motion& motion);

  /// Finds the hits.
  void find();
  /// Integrates the contact impulse over the hits of find().
  const ContactImpulse& integrate(const ContactOptions& options);

  /// Largest depth found by integrate() [m].
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
