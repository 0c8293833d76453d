#pragma once

#include <gtest/gtest.h>

#include "ros/tf/tf_tracker.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::test {

/// Three bodies, on two frames that move and on the fixed one, and the tracker of their pairs.
class TfTrackerTest : public ::testing::Test {
 protected:
  void send(const geometry_msgs::TransformStamped& transform, bool is_static = false) {
    tf2_msgs::TFMessage message;
    message.transforms = {transform};
    history_.add(message, is_static);
  }

  /// Both frames at their origins.
  void sendBoth(double time) {
    for (const char* frame : {"hand", "foot"}) send(stampedTransform("world", frame, time, 0.0));
  }

  /// Start and end of the pair's span in the current cycle [s].
  double spanStart(int pair) const { return spanTime(cycle_.motion.span(pair).first); }
  double spanEnd(int pair) const { return spanTime(cycle_.motion.span(pair).last); }
  double spanTime(std::size_t waypoint) const {
    return (cycle_.origin + ros::Duration(cycle_.motion.times[waypoint])).toSec();
  }

  using Step = TfTracker::Step;
  Step next(double now) { return tracker_.next(ros::Time(now), cycle_); }

  TfHistory history_{"/world"};
  TfTracker tracker_{history_,
                     {{"/hand", Isometry3d::Identity(), {Vector3d::Zero(), 0.1}},
                      {"foot", Isometry3d::Identity(), {Vector3d::Zero(), 0.1}},
                      {"world", Isometry3d::Identity(), {Vector3d::Zero(), 1.0}}},
                     {{0, 1, true, true}, {0, 2, true, true}, {1, 2, true, true}},
                     TfTrackerOptions()};
  TrackedCycle cycle_;
};

}  // namespace sdf_ccd::test
