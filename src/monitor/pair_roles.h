#pragma once

#include <array>
#include <optional>
#include <vector>

#include "contact_collector.h"
#include "pair_role.h"

namespace sdf_ccd {

/// All roles of a pair, one to four, and what they prove together.
class PairRoles {
 public:
  using Memory = std::array<RoleMemory, 4>;

  PairRoles(const Scene& scene, const PlannedPair& pair);

  /// Whether all fields and shells that the pair needs were built; otherwise it cannot be tested.
  bool areBuilt() const { return are_built_; }
  bool empty() const { return roles_.empty(); }
  const PairRole& front() const { return roles_.front(); }

  /// See PairRole::setMotion().
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span, Memory& memory);

  /// Upper bounds of the relative displacement of the bodies' points, and of the error of these points from poses and
  /// the shells' position errors [m].
  double travel() const { return travel_; }
  double poseError() const { return pose_error_; }

  /// Lower bound of the bodies' distance over the whole motion, from the balls of the shells alone [m]; −∞ if unknown.
  double ballClearance() const;

  /// If one ball alone proves that the bodies stay farther apart than `margin` [m]: lower bound of their distance at
  /// the end [m].
  std::optional<double> clearanceByBalls(double margin) const;

  /// Cuts the motions into chords. @return upper bound of the points' deviation from them [m].
  double cut(const ChordOptions& options);

  /// False only if every shell point stays farther than `distance` [m] from the other body's fields.
  bool mayComeNearer(double distance);

  /// Lower bound of the distance of all shell points from the fields at the end: PairRole::pointClearanceAtEnd().
  double pointClearanceAtEnd(double slack) const;

  /// Whether a shell is known to be outside this body at the end: PairRole::isOutsideAtEnd().
  bool isOutsideAtEnd(int body) const;

  /// Adds the contacts of all roles; cut() must have been called.
  /// @param bodies  of the scene.
  void addContacts(const std::vector<ContactCollector::BodyData>& bodies, const ContactOptions& options,
                   bool with_impulse, ContactCollector& collector);

 private:
  double forceWeight(const PairRole& role) const;

  int body_b_;
  std::vector<PairRole> roles_;
  bool are_built_;
  double finest_spacing_;    // of the shells that bear force: their smallest covering radius [m]
  double travel_ = 0.0;      // [m]
  double pose_error_ = 0.0;  // [m]
};

}  // namespace sdf_ccd
