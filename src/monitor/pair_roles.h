#pragma once

#include <array>
#include <vector>

#include "contact_collector.h"
#include "pair_role.h"

namespace sdf_ccd {

/// The roles of a pair, two at most, by which its contacts and forces are found. A pair whose bodies have no shell (two
/// maps, a map and a half-space) has none.
class PairRoles {
 public:
  using Memory = std::array<RoleMemory, 2>;

  PairRoles(const Scene& scene, const PlannedPair& pair);

  bool empty() const { return roles_.empty(); }

  /// See PairRole::setMotion().
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span, Memory& memory);

  /// Upper bounds of the relative displacement of the bodies' points, and of the error of these points from poses and
  /// the shells' position errors [m].
  double travel() const { return travel_; }
  double poseError() const { return pose_error_; }

  /// Cuts the motions into chords. @return upper bound of the points' deviation from them [m].
  double cut(const ChordOptions& options);

  /// Adds the contacts of all roles; cut() must have been called.
  /// @param bodies  of the scene.
  void addContacts(const std::vector<ContactCollector::BodyData>& bodies, const ContactOptions& options,
                   bool with_impulse, ContactCollector& collector);

 private:
  int body_b_;
  std::vector<PairRole> roles_;
  double finest_spacing_;    // of the shells: their smallest covering radius [m]
  double travel_ = 0.0;      // [m]
  double pose_error_ = 0.0;  // [m]
};

}  // namespace sdf_ccd
