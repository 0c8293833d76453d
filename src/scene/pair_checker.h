#pragma once

#include <limits>
#include <vector>

#include "contact_collector.h"
#include "pair_role.h"

namespace sdf_ccd {

/// Checks one pair, cycle after cycle. Owns the memory that needs, so that a cycle like the last allocates nothing.
class PairChecker {
 public:
  PairChecker(const Scene& scene, const PlannedPair& pair, const std::vector<ContactCollector::Siblings>& siblings,
              const MonitorOptions& options);

  /// Checks the pair over `result.span`, and keeps what it knows if that is empty. Never throws for a motion that
  /// cannot be followed: the pair is NOT_CHECKED then.
  void run(const CycleMotion& motion, const CycleRequest& request, PairResult& result);

  /// Forgets how far apart the bodies were.
  void forget() {
    clearance_ = kUnknown;
    for (PairRole& role : roles_) role.forget();
  }

 private:
  static constexpr double kUnknown = -std::numeric_limits<double>::infinity();

  void check(const CycleMotion& motion, const CycleRequest& request, PairResult& result);
  bool clearFromAfar(double margin, PairResult& result);
  void cutRoles(double motion_error, PairResult& result);
  void findContacts(const CycleMotion& motion, const CycleRequest& request, PairResult& result);

  const Scene& scene_;
  const PlannedPair& pair_;
  const std::vector<ContactCollector::Siblings>& siblings_;  // per body
  const MonitorOptions& options_;
  std::vector<PairRole> roles_;  // one or two
  ErrorBound bound_;             // of field and gap
  double clearance_ = kUnknown;  // lower bound of the surfaces' distance at the last cycle's end [m]
  ContactCollector collector_;
};

}  // namespace sdf_ccd
