#pragma once

#include <functional>
#include <vector>

#include "dynamics/rigid_motion.h"
#include "query/shell_query.h"

namespace sdf_ccd {

/// Contacts of one body's shell with another body's field during a step.
struct RoleHits {
  int shell_body;
  int field_body;
  double weight;          ///< share of the role's impulse where the other role finds the same contact: roleWeight()
  double tolerance;       ///< of the path's chords [m]
  const ChordPath& path;  ///< X_FP
  const std::vector<ShellHit>& hits;
};

/// Finds the contacts of all pairs of bodies during a step; pairs whose balls stay apart cost one comparison.
class ContactSearch {
 public:
  /// `world` must outlive this.
  explicit ContactSearch(const RigidWorld& world);

  /// Calls `visit` for every role that has hits, always in the same order.
  void run(const StepMotion& motion, const std::function<void(const RoleHits&)>& visit);

 private:
  struct Role {
    int shell_body, field_body;
    double weight;
  };
  bool mayMeet(const Role& role, const StepMotion& motion) const;

  const RigidWorld& world_;
  std::vector<Role> roles_;
  ChordPath path_;
  ShellQueryResult query_;
  std::vector<ShellHit> hits_;
};

}  // namespace sdf_ccd
