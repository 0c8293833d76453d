#pragma once

#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>

#include "oracle/random.h"

namespace sdf_ccd::test {

/// Fault of a stream.
enum class Trouble {
  kNone,
  kLate,              ///< one joint's transforms come up to 0.4 s late
  kSilent,            ///< one joint sends nothing for a while
  kOutOfOrder,        ///< some transforms arrive after their successors
  kTwoClocks,         ///< two publishers of one frame, whose clocks differ
  kLoop,              ///< a bag that is repeated
  kStaticThenMoving,  ///< a frame first on /tf_static, then on /tf
  kMovingThenStatic,
};
constexpr int kTroubles = 8;

struct TfEvent {
  double arrival = 0.0;  ///< [s]
  geometry_msgs::TransformStamped transform;
  bool is_static = false;
  bool jumps_back = false;  ///< time jumps back with this transform
};

/// Three seconds of an arm (frame `arm` below `world`) and a hand (`hand` below `base` below `world`), sorted by
/// arrival.
std::vector<TfEvent> randomStream(Random& random, Trouble trouble);

}  // namespace sdf_ccd::test
