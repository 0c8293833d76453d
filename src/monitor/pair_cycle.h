#pragma once

#include <array>
#include <vector>

#include "common/cancel_point.h"
#include "contact_collector.h"
#include "contact_times.h"
#include "pair_depth.h"
#include "resting_answers.h"
#include "surface/separation.h"

namespace sdf_ccd {

/// Scratch memory for checking a pair. It is reused for the next pair, so that a cycle like the last one allocates
/// nothing and the memory does not grow with the number of pairs.
struct PairMemory {
  std::array<RoleMemory, 2> roles;
  ContactCollector collector;
  std::vector<RelativeMotionBounds> bounds;  ///< of the motion of SurfacePair
  SeparationMemory separation;
  PairDepth::Memory depth;
  std::vector<TimeSample> samples;                                                      ///< of setContactTimes()
  CancelRequest::Clock::time_point deadline = CancelRequest::Clock::time_point::max();  ///< of all that is tested
};

/// What the check of a pair in a cycle reads, besides what is known of the pair.
struct PairCycle {
  const CycleMotion& motion;
  const SweptBodies& bodies;  ///< has the motion
  const CycleRequest& request;
  const MonitorOptions& options;
  RestingAnswers* resting;  ///< null: every cycle is tested
  PairMemory& memory;       ///< used by one check at a time

  PairMotion motionOf(const PairResult& pair) const { return {bodies, pair.body_a, pair.body_b, pair.span}; }
};

}  // namespace sdf_ccd
