#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "clearance_scan.h"

namespace sdf_ccd {

/// A pair that must be tested.
struct DuePair {
  /// Lower bound of its bodies' distance over the whole cycle, the motion's error taken off, at most zero: if negative,
  /// its amount bounds their overlap [m]; −∞ if nothing is known.
  float left;
  int pair;
};

/// Whether a pair cannot be tested because a body of it could not be built.
inline bool hasFailedBody(const Scene& scene, const PlannedPair& pair) {
  return !scene.bodies[pair.body_a].failure.empty() || !scene.bodies[pair.body_b].failure.empty();
}

/// Stores the clearance of every pair: how far its bodies may still move relative to each other before it must be
/// tested.
///
/// Pairs are stored in blocks of one body (the robot's, if the other is the world's) against kTwistLanes bodies of a
/// group, so that a scan reads all data as vectors without gathers. Lanes without a pair cost nothing extra. Clearances
/// are rounded down.
///
/// While the bodies of a block's group rest, no pair of it is closer than its clearance before minus the path of the
/// one body. So long as that leaves the smallest of the clearances far from used up, only this path is added up.
class ClearanceTable {
 public:
  /// @throws std::invalid_argument if two pairs are of the same bodies.
  ClearanceTable(const Scene& scene, const BodyTwists& bodies);

  /// Whether it holds the pair: not if a body of it could not be built, which is never tested. All else is about pairs
  /// that it holds.
  bool holds(int pair) const { return slots_[static_cast<std::size_t>(pair)] >= 0; }

  /// @param error  the pair's error bound, without the motion's error [m].
  void setError(int pair, double error);

  /// Sets the clearance of a pair that a test has found clear, and whose bodies are followed from there on.
  /// @param clearance  lower bound of the distance [m].
  void set(int pair, double clearance);
  /// Until set() is called, SkippedPairs::due_next is not the pair.
  void pauseDueNext(int pair);
  void forget(int pair);
  void forget();

  /// Takes over clearances from another table between two cycles. @param pairs_now  per pair of the other table: its
  /// index in this one; −1 if it is not there.
  void adopt(const ClearanceTable& other, const std::vector<int>& pairs_now);

  /// Subtracts an upper bound of the bodies' relative displacement between two cycles [m]. The clearance is forgotten
  /// if it is used up: one body may be inside the other then, though their surfaces are apart.
  void consume(int pair, double displacement);

  /// Whether the pair has a known clearance.
  bool isKnown(int pair) const { return clearance_[slot(pair)] != kUnknownClearance; }

  /// A lower bound of the distance after the last scan; for a due pair, before it [m].
  double clearance(int pair) const { return clearanceIn(slot(pair)); }

  /// Subtracts an upper bound of the bodies' relative displacement in a step that is not the cycle's last.
  void advance(const BodyTwists& bodies);

  /// The same for the last step. Pairs are due if their clearance is used up, or if one of their bodies is not
  /// followed; their clearances stay as they were at the cycle's start.
  /// @param due  receives the due pairs, the most urgent first; its memory is reused.
  /// @param margin  what must be left of a clearance [m].
  SkippedPairs finish(const BodyTwists& bodies, std::vector<DuePair>& due, double margin = 0.0);

 private:
  std::size_t slot(int pair) const { return static_cast<std::size_t>(slots_[static_cast<std::size_t>(pair)]); }

  static std::size_t blockOf(std::size_t slot) { return slot / kTwistLanes; }
  double clearanceIn(std::size_t slot) const;
  float& changeable(int pair);
  void endWait(PairBlock& block);

  std::vector<PairBlock> blocks_;
  std::vector<std::int32_t> slots_;  // per pair
  std::vector<std::int32_t> pairs_;  // per slot; -1: no pair
  std::vector<float> clearance_;     // per slot [m]
  std::vector<float> consumed_;      // per slot: displacement in the cycle's steps up to now [m]
  std::vector<float> error_;         // per slot [m]
  std::vector<float> due_next_;      // per slot: cycles in which SkippedPairs::due_next would be due; else kPaused
  std::vector<float> slack_;         // per slot: clearance that remains after the last scan [m]
  std::vector<std::size_t> due_blocks_;
  bool has_consumed_ = false;
};

}  // namespace sdf_ccd
