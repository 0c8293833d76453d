#include "monitor/tf_cycles.h"

#include <ros/serialization.h>

#include "ros/monitor/cycle_messages.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr double kStart = 1000.0;  // start time of the clock [s]

/// What the nodelet requests while something subscribes to its contacts.
CycleRequest asForContacts() {
  CycleRequest request;
  request.max_points = 20;  // the parameter's default
  request.skipped_pairs = false;
  return request;
}

std::shared_ptr<const RobotModel> shared(const RobotModel& robot) {
  return {std::shared_ptr<const RobotModel>(), &robot};
}

}  // namespace

TfCycles::TfCycles(const Robot& robot, const BoxWorld& world, std::shared_ptr<const Scene> scene,
                   const MonitorOptions& options, double period)
    : world_(world), period_(period), joints_(shared(robot.model), ""), now_(kStart) {
  DescribedScene described;
  described.robot = shared(robot.model);
  described.scene = world.scene;
  described.root_frame = described.fixed_frame = robot.model.root();
  MonitorParameters parameters;
  parameters.monitor = options;
  loop_ = std::make_unique<MonitorLoop>(std::move(scene), described, parameters);
  loop_->history().add(joints_.fixed(now_, [](const std::string&) { return true; }), true);
  prepare(0);
  run();  // the first cycle begins
}

void TfCycles::prepare(std::size_t i) {
  now_ += ros::Duration(period_);
  positions_.name.clear();
  positions_.position.clear();
  for (const auto& [joint, position] : world_.motion.positionsAt(static_cast<double>(i + 1) * period_)) {
    positions_.name.push_back(joint);
    positions_.position.push_back(position);
  }
  message_ = joints_.moved(positions_, now_);
}

void TfCycles::run() {
  monitor_seconds_ = 0.0;
  loop_->history().watchClock(now_);
  loop_->history().add(message_, false);
  if (loop_->step(now_, asForContacts()) != TfTracker::Step::kCycle) return;
  monitor_seconds_ = loop_->result().run_time;
  setContactArray(*loop_, contacts_);
  ros::serialization::serializeMessage(contacts_);
}

}  // namespace sdf_ccd::benchmark
