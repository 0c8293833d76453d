#pragma once

#include <cstddef>
#include <vector>

#include "clearance_table.h"
#include "pair_checker.h"

namespace sdf_ccd {

/// Says each cycle which pairs have to be tested. What it knows of the others stays in a table, and neither they nor
/// their results are touched; what it knows of a pair that is due is handed to that pair's checker.
///
/// A pair is not due if it was clear at the end of the last cycle by more than its bodies can have moved since, its
/// motion goes on from there bit by bit, and it is checked over all of the cycle. All others are, and their checkers
/// find out about delays, jumps and parts of a cycle, pair by pair.
class Schedule {
 public:
  /// @param checkers  of the scene's pairs.
  Schedule(const Scene& scene, const std::vector<PairChecker>& checkers);

  /// Takes a cycle's motion. @return the pairs that are due, the most urgent first.
  const std::vector<DuePair>& take(const CycleMotion& motion, std::vector<PairChecker>& checkers);

  /// Of the cycle that was taken: whether all pairs are checked over all of it.
  bool isAllWhole() const { return all_whole_; }
  const std::vector<DuePair>& due() const { return due_; }
  int quietCount() const { return static_cast<int>(scene_.pairs.size() - due_.size()); }

  /// The pair that is not due with the largest error bound; −1 if all are due.
  int worstQuiet() const { return quiet_.pair; }

  /// Of a pair that is not due: no less than what the motion adds to its error, and no more than its distance at the
  /// cycle's end [m].
  double motionError(int pair) const;
  double clearance(int pair) const { return table_.clearance(pair); }

  /// Of a pair that is due: a lower bound of its bodies' distance all over the cycle, below zero how far they may overlap
  /// at most [m]; −∞ if nothing is known.
  double leftClearance(const DuePair& due) const { return double(due.left) + table_.margin(due.pair); }

  /// Takes back what the checkers of the due pairs have found.
  void settle(const CycleMotion& motion, const std::vector<PairChecker>& checkers);

  void forget();

  /// What two schedules' scenes have in common.
  struct Kept {
    std::vector<BodyRun> bodies;  ///< those that both know
    std::vector<ClearanceTable::Moved> pairs;
  };
  ClearanceTable::Moved moved(int pair, const Schedule& other, int other_pair) const {
    return table_.moved(pair, other.table_, other_pair);
  }

  /// Takes over what another schedule knows between two cycles, without allocating.
  void take(const Schedule& other, const Kept& kept);

 private:
  bool isWhole(const CycleMotion& motion, std::size_t pair) const;
  void findWhole(const CycleMotion& motion);
  void handOver(const CycleMotion& motion, int pair, PairChecker& checker) const;

  const Scene& scene_;
  BodyTwists bodies_;
  ClearanceTable table_;
  std::vector<DuePair> due_;
  QuietPairs quiet_;
  std::vector<char> is_paired_;  // per body, before anything is taken: it is in a pair
  std::vector<char> is_whole_;   // per body: some pair of it is checked over all of the cycle
  bool all_whole_ = false;
};

}  // namespace sdf_ccd
