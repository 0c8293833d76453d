#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pair_force.h"
#include "pair_measure.h"
#include "pair_verdict.h"

namespace sdf_ccd {

/// What a monitor knows of a pair, and keeps from cycle to cycle. It depends on the two bodies, not on the scene.
struct MonitoredPair {
  using SharedBody = std::shared_ptr<const MonitoredBody>;

  /// @param pair  of these bodies: tells whose shells are used.
  MonitoredPair(SharedBody of_a, SharedBody of_b, const PlannedPair& pair, double max_error);

  SharedBody a, b;
  PairVerdict verdict;
  PairForce force;
  PairMeasure measure;
  std::optional<Isometry3d> X_AB_as_it_came;  ///< where the bodies rest, and the answer depends on the motion before
  bool is_to_complete = false;                ///< completePair() is to follow checkPair()
  int waited = 0;  ///< cycles in which it was left over since its last test; negative after a search in vain

  void forget() {
    verdict.forget();
    measure.forget();
    X_AB_as_it_came.reset();
  }
};
using MonitoredPairs = std::vector<std::shared_ptr<MonitoredPair>>;

/// Checks a pair over `result.span`; if that is empty, what is known is neither read nor changed. Does not throw if a
/// body's poses cannot be followed: the pair is then NOT_CHECKED.
///
/// The surfaces decide. If the pair is not clear, and contacts are wanted, the shells find them, with their forces;
/// then the surfaces measure them. Where the surfaces are known to cross, that is left to completePair(): the result is
/// incomplete until then.
/// @param result  names the bodies.
/// @throws Cancelled if there is no verdict before PairMemory::deadline. A contact that is proved by then is one, but
/// PairResult::incomplete.
void checkPair(const PairCycle& cycle, MonitoredPair& pair, PairResult& result);

/// Computes what is missing in an incomplete result of checkPair() with the same arguments, if it left something.
/// Where PairMemory::deadline comes first, it stays incomplete.
void completePair(const PairCycle& cycle, MonitoredPair& pair, PairResult& result);

/// Leaves the pair untested, over a span that is not empty: UNCERTAIN, or CLEAR if the bodies' balls stay apart.
/// @param clearance  lower bound of the bodies' distance over the whole span [m]; if negative, its amount bounds
/// their overlap; −∞ if nothing is known.
void postponePair(const PairCycle& cycle, double clearance, MonitoredPair& pair, PairResult& result);

/// Measures the distance of a pair that is known to be clear over the whole span. What is known stays.
/// @return a lower bound at the span's end [m]; empty if none is found.
std::optional<double> measureClearance(const PairCycle& cycle, MonitoredPair& pair, const PairResult& result);

}  // namespace sdf_ccd
