#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "body_twists.h"

namespace sdf_ccd {

/// A pair that has to be tested.
struct DuePair {
  float left;  ///< of its budget, below zero [m]; −∞ if nothing is known
  int pair;
};

/// What a scan says of the pairs that are not due.
struct QuietPairs {
  float error = -1.0F;  ///< largest error bound of theirs [m]; below zero if there are none
  int pair = -1;        ///< whose it is
};

/// Of every pair, how far its bodies may still move against each other before it has to be tested: its budget, the
/// clearance that is known beyond the margin at which a test could find something.
///
/// Pairs stand in blocks: one body against kTwistLanes bodies in a row, so that a scan reads all in vectors and gathers
/// nothing. Lanes without a pair cost nothing more. A budget is never rounded up.
class ClearanceTable {
 public:
  static constexpr float kUnknown = -std::numeric_limits<float>::infinity();

  /// @throws std::invalid_argument if two pairs are of the same bodies.
  explicit ClearanceTable(const std::vector<PlannedPair>& pairs);

  /// @param margin  at which a test could find something, but for the motion's error [m].
  /// @param error   the pair's error bound, but for the motion's error [m].
  void setMargin(int pair, double margin, double error);

  /// Of a pair that a test has found clear, and whose bodies are followed from there on.
  /// @param clearance  lower bound of the distance [m].
  void set(int pair, double clearance);
  void forget(int pair) { budget_[slot(pair)] = kUnknown; }
  void forget();

  /// A pair of this table and where another table has it.
  struct Moved {
    std::int32_t to, from;  // slots
  };
  Moved moved(int pair, const ClearanceTable& other, int other_pair) const {
    return {slots_[static_cast<std::size_t>(pair)], other.slots_[static_cast<std::size_t>(other_pair)]};
  }

  /// Takes over what another table knows between two cycles.
  void take(const ClearanceTable& other, const std::vector<Moved>& pairs) {
    for (const Moved& pair : pairs)
      budget_[static_cast<std::size_t>(pair.to)] = other.budget_[static_cast<std::size_t>(pair.from)];
  }

  /// Whether something is known of the pair.
  bool isKnown(int pair) const { return budget_[slot(pair)] != kUnknown; }

  /// A lower bound of the distance [m], where the last scan left it; of a due pair, before that.
  double clearance(int pair) const { return double(budget_[slot(pair)]) + margin_[static_cast<std::size_t>(pair)]; }
  double margin(int pair) const { return margin_[static_cast<std::size_t>(pair)]; }

  /// Subtracts what the bodies can have moved against each other in a step that is not the cycle's last.
  void advance(const BodyTwists& bodies);

  /// The same in the last step. Pairs whose budget is used up, or has nothing to do with the motion as a body is not
  /// followed, are due, and their budgets stay as they were at the cycle's start.
  /// @param due  is set, the most urgent first; memory reused.
  QuietPairs finish(const BodyTwists& bodies, std::vector<DuePair>& due);

 private:
  struct Block {
    std::int32_t body_a;
    std::int32_t first_b;  // a multiple of kTwistLanes
  };

  std::size_t slot(int pair) const { return static_cast<std::size_t>(slots_[static_cast<std::size_t>(pair)]); }

  std::vector<Block> blocks_;
  std::vector<std::int32_t> slots_;  // per pair
  std::vector<double> margin_;       // per pair [m]
  std::vector<std::int32_t> pairs_;  // per slot; -1: none
  std::vector<float> budget_;        // per slot [m]
  std::vector<float> spent_;         // per slot, in the cycle's steps up to now [m]
  std::vector<float> error_;         // per slot [m]
  std::vector<float> slack_;         // per slot: what is left of the budget after the last scan [m]
  std::vector<std::size_t> due_blocks_;
  bool has_spent_ = false;
};

}  // namespace sdf_ccd
