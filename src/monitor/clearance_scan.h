#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "body_twists.h"

namespace sdf_ccd {

constexpr float kUnknownClearance = -std::numeric_limits<float>::infinity();
constexpr float kNoPair = 1e30F;  ///< a clearance that is never used up, for lanes without a pair
constexpr float kUpwards = 1.0F + 0x1p-20F;
constexpr float kDueNext = 2.0F, kPaused = -1.0F;  ///< of ScanArrays::due_next

/// Summary of a scan over the pairs that are not due.
struct SkippedPairs {
  float error = -1.0F;  ///< upper bound of their error bounds [m]; negative if there are none
  int pair = -1;        ///< the pair that comes nearest to it
  int due_next = -1;    ///< a pair that two more cycles like this one would make due, the one by the largest distance
};

/// Pairs of one body with the kTwistLanes bodies of a group.
struct PairBlock {
  std::int32_t rows_a;  ///< twistOffset() of the one body
  std::int32_t group;   ///< of the others
  /// The smallest of the pairs' clearances at their last scan; −∞ if they must be scanned again [m].
  float least = kUnknownClearance;
  float path = 0.0F;       ///< bound of the one body's path since then, in which the others rested [m]
  float error = 0.0F;      ///< the largest error bound, without the motion's error [m]
  std::int32_t worst = 0;  ///< the slot of the pair with that bound
};

/// Adds to each pair's displacement an upper bound of that in a step.
void addTravel(const float* rows, const std::vector<PairBlock>& blocks, float* consumed);

/// Arrays of a scan, in the order of the blocks.
struct ScanArrays {
  const float* rows;
  const TwistGroup* groups;
  PairBlock* blocks;
  std::size_t count;
  float* clearance;
  float* consumed;
  float* slack;
  const float* error;
  const float* due_next;  ///< cycles in which a pair would be due next; else kPaused
  float margin;
};

/// Sets `slack` to what remains after the error, and `clearance` for the pairs that are not due. @return the largest
/// error and its slot, and the slot of the pair that will be due next.
SkippedPairs scanPairs(const ScanArrays& s, bool add_consumed, std::size_t* due_blocks, std::size_t* due_count);

}  // namespace sdf_ccd
