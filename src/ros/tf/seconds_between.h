#pragma once

#include <chrono>
#include <cstdint>

#include <ros/time.h>

namespace sdf_ccd {

constexpr double kLongestDuration = 2147483647.0;  // longest difference of two times that ROS can compute [s]

/// Stamps and clocks that go back by less are late, or corrected; those that go back by more have jumped [s].
constexpr double kJumpBack = 1.0;

/// to - from [s], of times or durations. A ros::Duration holds at most 2^31 s, and subtraction in ROS throws beyond;
/// clocks, stamps and requests from other nodes may be that far apart.
template <class Time>
double secondsBetween(const Time& from, const Time& to) {
  constexpr std::int64_t kPerSecond = 1000000000;
  const std::int64_t difference = static_cast<std::int64_t>(to.toNSec()) - static_cast<std::int64_t>(from.toNSec());
  return static_cast<double>(difference / kPerSecond) + 1e-9 * static_cast<double>(difference % kPerSecond);
}

inline std::chrono::nanoseconds sinceEpoch(const ros::Time& time) {
  return std::chrono::nanoseconds(time.toNSec());
}

}  // namespace sdf_ccd
