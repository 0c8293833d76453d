// Fuzzes incoming transforms and the clock, and runs the monitor's cycles on them.
#include <cmath>

#include "ros/monitor/cycle_messages.h"
#include "small_monitor.h"

namespace sdf_ccd::fuzz {
namespace {

/// A stamp within 2 s of `now`; sometimes any time that a message can hold.
ros::Time stampOf(Numbers& numbers, double now) {
  if (numbers.below(64) == 0) return ros::Time(numbers.byte() * 0x01010101U, 0);
  return ros::Time(std::max(0.0, now + (numbers.byte() - 128) / 64.0));
}

}  // namespace
}  // namespace sdf_ccd::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  static fuzz::SmallMonitor monitor;
  fuzz::Numbers numbers(data, size);
  monitor.begin();
  double now = fuzz::SmallMonitor::kStart;
  for (int i = 0; i < 200 && !numbers.done(); ++i) {
    const std::size_t what = numbers.below(4);
    if (what == 0) {
      now += numbers.below(32) == 0 ? -static_cast<double>(numbers.below(60)) : numbers.byte() / 512.0;
      if (monitor.loop().step(ros::Time(std::max(0.0, now)), {}) == TfTracker::Step::kCycle) {
        toContactArray(monitor.loop());
      }
      continue;
    }
    geometry_msgs::TransformStamped sent;
    sent.header.frame_id = fuzz::nameOf(numbers);
    sent.child_frame_id = fuzz::nameOf(numbers);
    sent.header.stamp = fuzz::stampOf(numbers, now);
    fuzz::takePose(numbers, sent.transform.rotation, sent.transform.translation);
    monitor.loop().history().add(test::message({sent}), what == 3);
  }
  return 0;
}
