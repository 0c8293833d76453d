#pragma once

#include <string>
#include <vector>

#include "pair_cycle.h"

namespace sdf_ccd {

/// Finds the contacts and forces of a pair by the points of each body's shell in the other body's field, with the
/// errors of both. A pair whose bodies have no shell (two maps, a map and a half-space) has no force.
class PairForce {
 public:
  /// The bodies must outlive this. @param pair  of these bodies: tells whose shells are used.
  PairForce(const MonitoredBody& a, const MonitoredBody& b, const PlannedPair& pair);

  /// Sets times, points and wrenches, and their error.
  /// @param given_error  RelativeMotion::givenError() [m].
  /// @param crosses      whether the surfaces are known to cross.
  void findContacts(const PairCycle& cycle, double given_error, bool crosses, PairResult& result);

  /// Says of a contact that its force is not known, if there are no shells.
  void explainNone(PairResult& result) const;

  /// The error of fields, and the gap between shell points [m].
  const ErrorSources& bound() const { return bound_; }

 private:
  std::vector<PairRole> roles_;
  double finest_spacing_;  // of the shells: their smallest covering radius [m]
  ErrorSources bound_;
  std::string why_none_;  // if there are no roles
};

}  // namespace sdf_ccd
