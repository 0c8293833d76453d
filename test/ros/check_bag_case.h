#pragma once

#include <sensor_msgs/JointState.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <rosbag/bag.h>

#include "tools/tool_run.h"

namespace sdf_ccd::test {

using Row = std::map<std::string, std::string>;  // by column name

constexpr double kBegin = 100.0, kSamplePeriod = 1.0 / 30.0;  // [s]
constexpr int kBefore = 20, kAfter = 20;                      // samples at rest
// config/demo/arm.urdf, with the hand pointing down: the finger is upright, at this distance from the axis of yaw.
constexpr double kReach = 0.5, kTipHeight = 0.31, kFinger = 0.008;        // [m]
constexpr double kPlateY = 0.18, kHalfPlate = 0.0005;                     // config/demo/world.yaml [m]
constexpr double kFirstYaw = 0.2, kYawStep = 0.1, kLastYaw = 0.6 + 1e-9;  // [rad]

inline double timeOfYaw(double yaw) {
  return kBegin + kSamplePeriod * (kBefore - 1 + (yaw - kFirstYaw) / kYawStep);
}

inline std::vector<Row> readCsv(const std::string& text) {
  std::istringstream lines(text);
  std::string line, cell;
  std::vector<std::string> names;
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line + ",");
    std::vector<std::string> values;
    while (std::getline(cells, cell, ',')) values.push_back(cell);
    if (names.empty()) {
      names = values;
      continue;
    }
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = values.at(i);
  }
  return rows;
}

/// The demo's arm swings its finger through the demo's plate, so fast that no sample shows it there.
class CheckBag : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    ::setenv("ROS_PACKAGE_PATH", SDF_CCD_SOURCE_DIR, 1);
    const std::string world = readText(SDF_CCD_SOURCE_DIR "/config/demo/world.yaml");
    write("arm.yaml", world + "cache_directory: cache\nfield: {cell_size: 0.006}\nshell: {spacing: 0.003}\n");
    writeJointStates();
  }

  struct Pose {
    double shoulder, elbow, wrist;
  };

  /// The pose with the hand pointing down at kReach.
  static Pose downwards() {
    constexpr double kUpperArm = 0.4, kForearm = 0.35, kHand = 0.212, kShoulderHeight = 0.35;
    const double h = kTipHeight + kHand - kShoulderHeight, d = std::hypot(kReach, h);
    const double lift = std::acos((kUpperArm * kUpperArm + d * d - kForearm * kForearm) / (2.0 * kUpperArm * d));
    const double shoulder = -(std::atan2(h, kReach) + lift);
    const double elbow =
        M_PI - std::acos((kUpperArm * kUpperArm + kForearm * kForearm - d * d) / (2.0 * kUpperArm * kForearm));
    return {shoulder, elbow, M_PI_2 - shoulder - elbow};
  }

  /// Writes held.bag: eight seconds with the finger in the plate.
  /// @param is_silent  whether the elbow's position is left out at a time [s]; between `from` and `until` there are no
  /// messages at all.
  void writeHeldContact(const std::function<bool(double)>& is_silent, double from = 9.0, double until = 9.0) {
    rosbag::Bag bag(path("held.bag").string(), rosbag::bagmode::Write);
    const Pose pose = downwards();
    for (int i = 0; i < 240; ++i) {
      const double time = kSamplePeriod * i;
      if (time > from && time < until) continue;
      sensor_msgs::JointState state;
      state.header.stamp = ros::Time(kBegin + time);
      state.name = {"yaw", "shoulder", "wrist", "roll"};
      state.position = {std::asin(kPlateY / kReach) + 0.002 * std::sin(i), pose.shoulder, pose.wrist, 0.0};
      if (!is_silent(time)) {
        state.name.push_back("elbow");
        state.position.push_back(pose.elbow);
      }
      bag.write("joint_states", state.header.stamp + ros::Duration(0.005), state);
    }
  }

  /// Writes the joint states of the sweep, stamped 5 ms before they are recorded.
  /// @param later  if above 0, adds them to the bag again, recorded this much later [s].
  void writeJointStates(double later = 0.0) {
    const Pose pose = downwards();
    std::vector<double> yaws(kBefore - 1, kFirstYaw);
    for (double yaw = kFirstYaw; yaw < kLastYaw; yaw += kYawStep) yaws.push_back(yaw);
    yaws.insert(yaws.end(), kAfter, yaws.back());
    rosbag::Bag bag(path("arm.bag").string(), later > 0.0 ? rosbag::bagmode::Append : rosbag::bagmode::Write);
    for (std::size_t i = 0; i < yaws.size(); ++i) {
      sensor_msgs::JointState state;
      state.header.stamp = ros::Time(kBegin + kSamplePeriod * double(i));
      state.name = {"yaw", "shoulder", "elbow", "wrist", "roll", "unknown"};
      state.position = {yaws[i], pose.shoulder, pose.elbow, pose.wrist, 0.0, 1.0};
      bag.write("joint_states", state.header.stamp + ros::Duration(0.005 + later), state);
    }
  }

  /// The command line; it names a configuration unless the options do.
  std::string check(const std::string& bag, const std::string& out, const std::string& options = "") const {
    const std::string config = options.find("--config") == std::string::npos ? "--config arm.yaml " : "";
    return "check-bag " + bag + " --urdf " SDF_CCD_SOURCE_DIR "/config/demo/arm.urdf " + config + options + " --out " +
           out;
  }
  std::vector<Row> table(const std::string& name) const { return readCsv(readText(path(name))); }
};

}  // namespace sdf_ccd::test
