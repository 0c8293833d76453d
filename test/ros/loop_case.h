#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "oracle/scene_case.h"
#include "ros/described_world.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::test {

using Step = TfTracker::Step;

constexpr double kPeriod = 0.033;                  // [s]
constexpr double kRadius = 0.05, kPlate = 0.5;     // of hand and foot, x of the plate [m]
constexpr double kPlateHalf = 0.005, kHigh = 2.0;  // the foot's x where it is far from everything [m]

inline std::shared_ptr<const Scene> handFootAndPlate() {
  static const auto built =
      build({body("hand", Sphere{kRadius}), body("foot", Sphere{kRadius}),
             [] {
               BodyDescription plate = body("plate", Box::fromSize({2.0 * kPlateHalf, 1.0, 1.0}), true);
               plate.geometry[0].X_BG.translation().x() = kPlate;
               return plate;
             }()},
            fine(0.005));
  return built;
}

/// A loop that receives transforms, and its messages.
class MonitorLoopTest : public ::testing::Test {
 protected:
  MonitorLoopTest() { begin(); }

  void begin(double max_latency = 0.5, double max_cycle = 1.0) {
    MonitorParameters parameters;
    parameters.monitor = soft();
    parameters.tf.max_latency = max_latency;
    parameters.contact_join = {};  // a contact ends where it ends
    parameters.tf.max_cycle = max_cycle;
    loop_ = std::make_unique<MonitorLoop>(handFootAndPlate(), describedWorld(), parameters);
    said_.clear();
  }

  void send(const geometry_msgs::TransformStamped& sent, bool is_static = false) {
    loop_->history().add(message({sent}), is_static);
  }
  void sendHand(double stamp, double x, bool is_static = false) {
    send(stampedTransform("world", "hand", stamp, x), is_static);
  }
  void sendFoot(double stamp, double x = kHigh) { send(stampedTransform("world", "foot", stamp, x)); }

  Step step(double now) {
    const Step step = loop_->step(ros::Time(now), {});
    if (step == Step::kCycle) said_.push_back(toContactArray(*loop_));
    return step;
  }

  const ContactArray& last() const { return said_.back(); }
  int verdicts(std::uint8_t verdict) const {
    return static_cast<int>(
        std::count_if(said_.begin(), said_.end(), [&](const ContactArray& said) { return said.verdict == verdict; }));
  }
  const PairContact* pairOf(const ContactArray& said, const std::string& a, const std::string& b) const {
    for (const PairContact& pair : said.pairs) {
      if (pair.body_a == a && pair.body_b == b) return &pair;
    }
    return nullptr;
  }

  std::unique_ptr<MonitorLoop> loop_;
  std::vector<ContactArray> said_;
};

}  // namespace sdf_ccd::test
