#pragma once

#include <functional>
#include <memory>
#include <vector>

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

/// What is wanted of many motions at a time, as of the edges of a planner's graph.
struct MotionsRequest {
  /// Whether a motion is left where it is first found to be other than CLEAR; its verdict is the one of there then, or
  /// a worse one.
  bool first_only = true;

  /// CLEAR is only what stays farther apart than this [m]. What comes nearer is UNCERTAIN, and so is a contact that is
  /// less deep.
  double margin = 0.0;

  /// How far samples of a motion may stray from it [m], coarse first: what is not CLEAR is looked at again with the
  /// next one. Most of a planner's edges are far from everything, and the coarse look takes a fraction of the fine one.
  std::vector<double> tolerances = {0.01, 1e-4};
};

/// What became of one of many motions.
struct MotionVerdict {
  Verdict verdict = Verdict::kNotChecked;
  double error_bound = 0.0;  ///< largest of the pairs checked, the margin not counted [m]
  int pair = -1;             ///< in Scene::pairs: the first found that has the verdict; −1 if that is CLEAR
  double time = -1.0;        ///< when they were found to touch, or else the begin of the part where that was found [s];
                             ///< −1 if CLEAR
};

/// Checks motions on all cores, each for itself. Of a motion that is not CLEAR, checkMotion() tells all.
/// @param motionOf  makes a motion by its index, with samples that stray so far; is called on many threads at a time.
/// @return per motion; the same whatever the number of threads.
/// @throws what motionOf throws; std::invalid_argument for a margin that is negative or not finite, or no tolerances.
std::vector<MotionVerdict> checkMotions(std::shared_ptr<const Scene> scene, const MonitorOptions& options,
                                        std::size_t count,
                                        const std::function<PlannedMotion(std::size_t i, double tolerance)>& motionOf,
                                        const MotionsRequest& request = {});

/// The bodies of a scene, each carried by the link whose frame it has: objects of the world by the robot's root, or by
/// what holds them. Of bodies in other frames nothing is known; their pairs are NOT_CHECKED.
PlannedBodies bodiesOf(const Scene& scene, const RobotModel& robot);

}  // namespace sdf_ccd
