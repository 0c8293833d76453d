#include "monitor/recorded_poses.h"

#include <algorithm>
#include <stdexcept>

#include "ros/bag/recorded_motion.h"
#include "ros/tf/tf_tracker.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr double kKeep = 1e5;  // length of the history, longer than any bag [s]

}  // namespace

std::vector<std::vector<Isometry3d>> recordedPoses(const std::string& bag, const Robot& robot, double period,
                                                   std::size_t most) {
  DescribedScene described;
  described.robot = {std::shared_ptr<const RobotModel>(), &robot.model};
  described.scene = robot.scene;
  described.root_frame = described.fixed_frame = robot.model.root();
  const RecordedMotion motion(bag, described, {});
  TfHistoryOptions options;
  options.keep = kKeep;
  std::vector<TrackedBody> bodies;
  for (const BodyDescription& body : robot.scene.bodies) {
    bodies.push_back({body.frame, body.X_frame_B, {}});
    options.wanted.push_back(body.frame);
  }
  TfHistory history(robot.model.root(), options);
  motion.play([&](const RecordedTransforms& transforms) { history.add(transforms.message, transforms.is_static); });

  ros::Time start;
  for (const TrackedBody& body : bodies) {
    const TfSpan span = history.span(body.frame);
    if (!span.problem.empty()) throw std::runtime_error(bag + ": " + body.frame + ": " + span.problem);
    if (!span.is_static) start = std::max(start, span.first);
  }
  std::vector<std::vector<Isometry3d>> poses;
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < most; ++i) {
    std::vector<Isometry3d> X_RB;
    posesAt(history, bodies, start + ros::Duration(period * double(i)), X_RB, missing);
    if (std::any_of(missing.begin(), missing.end(), [](const std::string& why) { return !why.empty(); })) break;
    poses.push_back(std::move(X_RB));
  }
  if (poses.size() < 2) throw std::runtime_error(bag + ": at no time are all bodies of " + robot.name + " known");
  return poses;
}

}  // namespace sdf_ccd::benchmark
