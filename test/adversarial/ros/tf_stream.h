#pragma once

#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>

#include "oracle/random.h"

namespace sdf_ccd::test {

/// What goes wrong on the way.
enum class Trouble {
  kNone,
  kLate,              ///< one joint's transforms come up to 0.4 s late
  kSilent,            ///< one joint says nothing for a while
  kOutOfOrder,        ///< neighbours arrive in the wrong order
  kTwoClocks,         ///< two publishers of one frame, their clocks apart
  kLoop,              ///< a bag that begins again
  kStaticThenMoving,  ///< a frame on /tf_static first, then on /tf
  kMovingThenStatic,
};
constexpr int kTroubles = 8;

struct TfEvent {
  double arrival = 0.0;  ///< [s]
  geometry_msgs::TransformStamped transform;
  bool is_static = false;
  bool jumps_back = false;  ///< time begins again with this one
};

/// Some seconds of an arm (frame `arm` on `world`) beside a hand (`hand` on `base` on `world`), in order of arrival.
std::vector<TfEvent> randomStream(Random& random, Trouble trouble);

}  // namespace sdf_ccd::test
