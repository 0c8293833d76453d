#include "ros/bag/bag_check.h"

#include <algorithm>

#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

constexpr const char* kStalls = "no new transforms";
constexpr double kAhead = 10.0;  // transforms may be stamped ahead of the clock that recorded them by as much [s]
constexpr double kShortestPeriod = 1e-6, kLongestPeriod = 1e6;  // limits set by clocks [s]

}  // namespace

void checkBag(const RecordedMotion& motion, const MonitorParameters& parameters, MonitorLoop& loop,
              BagObserver& observer) {
  const ros::Duration period(std::clamp(1.0 / parameters.rate, kShortestPeriod, kLongestPeriod));
  ros::Time::init();  // lets others read the clock that setNow() sets
  CycleRequest request;
  request.max_points = parameters.max_points;
  TfTracker::Step last = TfTracker::Step::kWaiting;
  ros::Time last_cycle;  // 0: none since the last jump of time
  ros::Time last_stamp = motion.end();
  // When transforms resume, the next cycle begins at the end of the last one.
  const auto tellGap = [&](const ros::Time& now) {
    const ros::Time from = loop.cycle().end;
    if (!last_cycle.isZero()) observer.onGap({from, from + (now - last_cycle)}, kStalls, now);
  };
  const auto stepAt = [&](const ros::Time& now) {
    ros::Time::setNow(now);
    const TfTracker::Step step = loop.step(now, request);
    const bool stalls = step == TfTracker::Step::kStalled && last != TfTracker::Step::kStalled;
    if (step == TfTracker::Step::kCycle) {
      observer.onCycle(now);
      last_cycle = now;
    }
    if (step == TfTracker::Step::kJump) {
      if (last == TfTracker::Step::kStalled) tellGap(now);
      observer.onUnchecked("time has jumped", now);
      last_cycle = ros::Time();
    }
    if (stalls) observer.onUnchecked(kStalls, now);
    last = step;
    return step;
  };
  ros::Time now = motion.begin();
  const auto runUntil = [&](const ros::Time& time) {
    for (; now < time; now += period) {
      // No cycle can begin before the next transforms, which may be years later: robots' clocks are set while they
      // record. The last period before them is stepped through, so that they are not ahead of the clock.
      if (stepAt(now) == TfTracker::Step::kStalled && time - now > period * 2.0) now = time - period * 2.0;
    }
  };
  motion.play([&](const RecordedTransforms& transforms) {
    runUntil(transforms.recorded);
    loop.history().add(transforms.message, transforms.is_static);
    observer.onTransforms(transforms);
    if (transforms.is_static) return;
    for (const geometry_msgs::TransformStamped& transform : transforms.message.transforms)
      last_stamp = std::max(last_stamp, transform.header.stamp);
  });
  runUntil(motion.end());
  now = motion.end();
  TfTracker::Step step = stepAt(now);
  // Where nothing moves, as in a bag of static transforms, the first cycle may still have to end.
  if (last_cycle.isZero() && step == TfTracker::Step::kWaiting) step = stepAt(now += period);
  const ros::Time until = secondsBetween(motion.end(), last_stamp) < kAhead ? last_stamp : motion.end();
  while (step == TfTracker::Step::kCycle && now < until) step = stepAt(now = std::min(now + period, until));
  if (step == TfTracker::Step::kStalled) tellGap(now);
}

}  // namespace sdf_ccd
