#pragma once

#include <memory>

#include "sdf_ccd/monitor/monitor.h"
#include "sdf_ccd/robot/planned_motion.h"

namespace sdf_ccd {

/// Checks a planned motion piece by piece, so that a long one takes little memory and can be left between two pieces.
class MotionCheck {
 public:
  /// @param motion  must outlive this.
  /// @param memory  as of a Monitor.
  MotionCheck(std::shared_ptr<const Scene> scene, const MonitorOptions& options, const PlannedMotion& motion,
              const CycleRequest& request, std::shared_ptr<MonitorMemory> memory = nullptr);
  MotionCheck(std::shared_ptr<const Scene>, const MonitorOptions&, PlannedMotion&&, const CycleRequest&,
              std::shared_ptr<MonitorMemory> = nullptr) = delete;
  ~MotionCheck();

  bool isDone() const;

  /// Checks the next piece, of some milliseconds, and returns its motion, which holds until the next call.
  const CycleMotion& next();

  /// Of all pieces that were checked, and of the pairs that the scene leaves out though they may meet: the pairs' spans
  /// are {0, 1}, the first and the last time of ends().
  CycleResult result() const;
  const CycleMotion& ends() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Checks all of a planned motion.
CycleResult checkMotion(std::shared_ptr<const Scene> scene, const MonitorOptions& options, const PlannedMotion& motion,
                        const CycleRequest& request = {});

/// The bodies of a scene, each carried by the link whose frame it has: objects of the world by the robot's root, or by
/// what holds them. Of bodies in other frames nothing is known; their pairs are NOT_CHECKED.
PlannedBodies bodiesOf(const Scene& scene, const RobotModel& robot);

}  // namespace sdf_ccd
