#include "sdf_ccd/robot_monitor/check_motion.h"

#include <algorithm>

#include "monitor/join_results.h"
#include "monitor/summarise.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kWaypointsPerPiece = 16;

}  // namespace

struct MotionCheck::Impl {
  const PlannedMotion& motion;
  Monitor monitor;
  CycleRequest request;
  ResultJoiner joiner;
  CycleMotion piece;
  std::size_t done;  // waypoint
};

MotionCheck::MotionCheck(std::shared_ptr<const Scene> scene, const MonitorOptions& options, const PlannedMotion& motion,
                         const CycleRequest& request, std::shared_ptr<MonitorMemory> memory)
    : impl_(new Impl{motion,
                     Monitor(std::move(scene), options, std::move(memory)),
                     request,
                     ResultJoiner(request.max_points),
                     {},
                     0}) {}

MotionCheck::~MotionCheck() = default;

bool MotionCheck::isDone() const {
  return impl_->done + 1 >= impl_->motion.waypoints.size();
}

const CycleMotion& MotionCheck::next() {
  const std::size_t last = std::min(impl_->done + kWaypointsPerPiece, impl_->motion.waypoints.size() - 1);
  impl_->motion.piece(impl_->done, last, impl_->piece);
  impl_->joiner.add(impl_->piece, impl_->monitor.run(impl_->piece, impl_->request));
  impl_->done = last;
  return impl_->piece;
}

CycleResult MotionCheck::result() const {
  CycleResult result = impl_->joiner.result();
  addUnchecked(impl_->motion.unchecked, result);
  return result;
}

const CycleMotion& MotionCheck::ends() const {
  return impl_->joiner.motion();
}

CycleResult checkMotion(std::shared_ptr<const Scene> scene, const MonitorOptions& options, const PlannedMotion& motion,
                        const CycleRequest& request) {
  MotionCheck check(std::move(scene), options, motion, request);
  while (!check.isDone()) check.next();
  return check.result();
}

PlannedBodies bodiesOf(const Scene& scene, const RobotModel& robot) {
  PlannedBodies planned;
  const std::vector<std::string>& links = robot.links();
  for (const Body& body : scene.bodies) {
    const auto found = std::find(links.begin(), links.end(), body.frame);
    const bool is_carried = found != links.end();
    const int link = is_carried ? static_cast<int>(found - links.begin()) : -1;
    planned.bodies.push_back({link, body.X_frame_B, motionBall(body)});
    planned.missing.push_back(is_carried ? ""
                                         : "the robot has no link \"" + body.frame + "\", the frame of " + body.name);
  }
  return planned;
}

}  // namespace sdf_ccd
