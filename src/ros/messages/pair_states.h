#pragma once

#include <optional>
#include <vector>

#include <ros/time.h>

#include "ros/messages/conversions.h"

namespace sdf_ccd {

/// What is known of a pair, for people to look at.
struct PairState {
  Verdict verdict = Verdict::kNotChecked;
  ros::Time until;         ///< of what is known; 0 if the pair was never checked
  ros::Time holds_until;   ///< a contact, or what may be one, is shown as long, whatever comes after
  double depth = 0.0;      ///< of the deepest point [m]; 0 if there is none
  double clearance = 0.0;  ///< lower bound of the distance at `until` [m]; negative if not known
};

/// The pairs' verdicts over time: those that wait for transforms keep theirs, and contacts stay for a while, so that
/// people see those of a single cycle.
class PairStates {
 public:
  /// @param hold  how long contacts stay [s].
  explicit PairStates(double hold) : hold_(hold) {}

  void setHold(double hold) { hold_ = hold; }

  void update(const CycleResult& result, const CycleContext& cycle);

  /// Goes on with other pairs. @param before  per pair: its index until now; -1 if it is new.
  void take(const std::vector<int>& before);

  /// Nothing is known any more.
  void clear();

  const std::vector<PairState>& pairs() const { return pairs_; }

  /// The worst of all pairs; NOT_CHECKED if there are none.
  Verdict verdict() const;

  /// Per body; none of those that are in no pair.
  std::vector<std::optional<Verdict>> ofBodies(const Scene& scene) const;

 private:
  double hold_;
  std::vector<PairState> pairs_;
};

}  // namespace sdf_ccd
