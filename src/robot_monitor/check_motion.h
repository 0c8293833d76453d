#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "robot/planned_motion.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// Checks a planned motion piece by piece, so that a long one takes little memory and can be stopped between pieces.
class MotionCheck {
 public:
  /// @param motion  must outlive this.
  /// @param memory  as for a Monitor.
  MotionCheck(std::shared_ptr<const Scene> scene, const MonitorOptions& options, const PlannedMotion& motion,
              const CycleRequest& request, std::shared_ptr<MonitorMemory> memory = nullptr);
  MotionCheck(std::shared_ptr<const Scene>, const MonitorOptions&, PlannedMotion&&, const CycleRequest&,
              std::shared_ptr<MonitorMemory> = nullptr) = delete;
  ~MotionCheck();

  /// Whether all pieces are checked.
  bool isDone() const;

  /// Checks the next piece, of some milliseconds, and returns its motion, which is valid until the next call.
  const CycleMotion& next();

  /// The result of all checked pieces. Pairs that the scene leaves out as rigidly joined or in the same frame, but that
  /// the motion moves relative to each other, are added as NOT_CHECKED. The pairs' spans are {0, 1}, the first and the
  /// last time of ends().
  CycleResult result() const;
  /// The bodies' poses at the first and the last time checked.
  const CycleMotion& ends() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Checks all of a planned motion.
CycleResult checkMotion(std::shared_ptr<const Scene> scene, const MonitorOptions& options, const PlannedMotion& motion,
                        const CycleRequest& request = {});

/// Options for checks of many motions, such as the edges of a planner's graph.
struct MotionsRequest {
  /// Whether a check stops at the first part of a motion that is not CLEAR; its verdict is then that of this part, or a
  /// worse one.
  bool first_only = true;

  /// Only what stays farther apart than this is CLEAR [m]. What comes closer is UNCERTAIN, and so is a contact that is
  /// less deep.
  double margin = 0.0;

  /// Whether MotionVerdict::pairs are wanted. Each motion that is not CLEAR is then checked as a whole, as by
  /// checkMotion(), whatever first_only says; only the finest check, and only of these motions, costs more.
  bool list_pairs = false;

  /// Maximum deviations of a motion's samples [m], coarse first: motions that are not CLEAR are checked again with the
  /// next one. Most of a planner's edges are far from everything, and a coarse check takes a fraction of a fine one.
  std::vector<double> tolerances = {0.01, 1e-4};

  PairTimes* times = nullptr;  ///< as CycleRequest::times
};

/// A pair that is not CLEAR over a motion.
struct MotionPairVerdict {
  int body_a = -1, body_b = -1;  ///< in Scene::bodies
  Verdict verdict = Verdict::kNotChecked;
  /// The begin of its first contact, as in checkMotion(); without a contact, of the first part of the motion that is
  /// not CLEAR [s] from the start.
  double time = 0.0;
};

/// The verdict about one of many motions.
struct MotionVerdict {
  Verdict verdict = Verdict::kNotChecked;
  double error_bound = 0.0;  ///< largest of the checked pairs, without the margin [m]
  int pair = -1;             ///< in Scene::pairs: the first one with the verdict; −1 if that is CLEAR
  double time = -1.0;        ///< of the contact, or else the begin of the part of the motion with the verdict [s];
                             ///< −1 if CLEAR. The first such time of all with MotionsRequest::list_pairs
  std::vector<MotionPairVerdict> pairs;  ///< all that are not CLEAR, by their times, if MotionsRequest::list_pairs
  std::vector<UncheckedPair> unchecked;  ///< pairs that MotionCheck::result() adds, of the part that was checked
};

/// Checks motions on all cores, independently. checkMotion() gives the full result of one that is not CLEAR.
/// @param motionOf  makes a motion by its index, with samples within the tolerance; called on several threads at once.
/// @return per motion; does not depend on the number of threads.
/// @throws what motionOf throws; std::invalid_argument for a margin that is negative or not finite, or no tolerances.
std::vector<MotionVerdict> checkMotions(std::shared_ptr<const Scene> scene, const MonitorOptions& options,
                                        std::size_t count,
                                        const std::function<PlannedMotion(std::size_t i, double tolerance)>& motionOf,
                                        const MotionsRequest& request = {});

/// The bodies of a scene, each carried by the link whose frame it has: objects of the world by the robot's root, or by
/// the link that they are attached to. Bodies whose frame has no name do not move in the world. Bodies in other frames
/// are missing; their pairs are NOT_CHECKED.
PlannedBodies bodiesOf(const Scene& scene, const RobotModel& robot);

}  // namespace sdf_ccd
