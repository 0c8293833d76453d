#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "check_pair.h"
#include "clearance_table.h"
#include "scene_difference.h"

namespace sdf_ccd {

/// Determines in each cycle which pairs must be tested. The clearances of the others stay in a table, and neither these
/// pairs nor their results are touched; the clearance of a due pair is passed to its PairVerdict.
///
/// A pair is not due if its clearance at the end of the last cycle exceeds what its bodies can have moved since, its
/// motion continues bitwise from there, and it is checked over the whole cycle. All other pairs are due, and their
/// checks handle delays, jumps and partial cycles pair by pair. Pairs of bodies that could not be built cost nothing.
class Schedule {
 public:
  /// @param pairs  those of the scene.
  Schedule(const Scene& scene, const MonitoredPairs& pairs);

  /// Processes a cycle's motion. @param margin  as CycleRequest::margin. @return the due pairs, the most urgent first.
  const std::vector<DuePair>& findDue(const CycleMotion& motion, double margin, const MonitoredPairs& pairs);

  /// Whether all pairs are checked over the whole cycle that was processed last.
  bool isAllWhole() const { return all_whole_; }
  const std::vector<DuePair>& due() const { return due_; }
  int skippedCount() const { return static_cast<int>(scene_.pairs.size() - failed_.size() - due_.size()); }

  /// The pairs of bodies that could not be built: these are never due, and their transforms do not matter.
  const std::vector<int>& failed() const { return failed_; }

  /// The pair with the largest error bound among those that are not due; −1 if all are due.
  int worstSkipped() const { return skipped_.pair; }
  /// Upper bound of all of their error bounds [m].
  double worstError() const { return skipped_.error; }

  /// A pair that is not due but will be next, if the motion continues; −1 if there is none.
  int dueNext() const { return skipped_.due_next; }

  /// Raises the clearance of dueNext(), if a larger one has been measured; otherwise the pair is not named again before
  /// it is due. @param clearance  lower bound of the distance at the cycle's end [m]; none if it could not be measured.
  void raiseDueNext(std::optional<double> clearance) {
    if (clearance && *clearance > table_.clearance(dueNext())) return table_.set(dueNext(), *clearance);
    table_.pauseDueNext(dueNext());
  }

  /// For a pair that is not due: upper bound of the motion's part of its error, and lower bound of its distance at the
  /// cycle's end [m].
  double motionError(int pair) const;
  double clearance(int pair) const { return table_.clearance(pair); }

  /// Moves the clearances that the checks of the due pairs have found into the table, where the bodies are followed.
  void finish(const CycleMotion& motion, const MonitoredPairs& pairs);

  void forget();

  /// Takes over the data of another schedule between two cycles, without allocating. New pairs whose clearance this
  /// schedule knows from an earlier cycle keep what is left of it, now that the common bodies are elsewhere.
  /// @param difference  of the other schedule's scene and this one's.
  void adopt(const Schedule& other, const SceneDifference& difference);

 private:
  bool isWhole(const CycleMotion& motion, std::size_t pair) const;
  void findWhole(const CycleMotion& motion);
  void consumeDisplacement(const Schedule& other, const SceneDifference& difference);
  void handOver(const CycleMotion& motion, int pair, PairVerdict& verdict) const;

  const Scene& scene_;
  BodyTwists bodies_;
  ClearanceTable table_;
  std::vector<DuePair> due_;
  std::vector<int> failed_;
  SkippedPairs skipped_;
  std::vector<char> is_paired_;  // per body: it is in a pair; swapped with is_whole_ by adopt()
  std::vector<char> is_whole_;   // per body: a pair of it is checked over the whole cycle
  bool all_whole_ = false;
};

}  // namespace sdf_ccd
