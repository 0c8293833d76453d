#pragma once

#include <optional>
#include <vector>

#include <ros/time.h>

#include "ros/messages/conversions.h"

namespace sdf_ccd {

/// Last known state of a pair, for display.
struct PairState {
  Verdict verdict = Verdict::kNotChecked;
  ros::Time until;         ///< time for which the state is known; 0 if the pair was never checked
  ros::Time holds_until;   ///< a CONTACT or UNCERTAIN is shown until this time, whatever follows
  double depth = 0.0;      ///< of the deepest point [m]; 0 if there is none
  double clearance = 0.0;  ///< lower bound of the distance at `until` [m]; negative if not known
};

/// The pairs' verdicts over time: pairs that wait for transforms keep theirs, and contacts are held for a while, so
/// that people see those of a single cycle.
class PairStates {
 public:
  /// @param hold  time for which contacts are held [s].
  explicit PairStates(double hold) : hold_(hold) {}

  void setHold(double hold) { hold_ = hold; }

  void update(const CycleResult& result, const CycleContext& cycle);

  /// Switches to other pairs. @param before  per pair: its former index; -1 if it is new.
  void switchPairs(const std::vector<int>& before);

  /// Makes all pairs NOT_CHECKED.
  void clear();

  const std::vector<PairState>& pairs() const { return pairs_; }

  /// The worst of all pairs; NOT_CHECKED if there are none.
  Verdict verdict() const;

  /// The worst of each body's pairs; none for bodies in no pair.
  std::vector<std::optional<Verdict>> ofBodies(const Scene& scene) const;

 private:
  double hold_;
  std::vector<PairState> pairs_;
};

}  // namespace sdf_ccd
