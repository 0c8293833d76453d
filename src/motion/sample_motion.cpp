#include "sample_motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/cancel_point.h"
#include "common/infinity.h"
#include "motion/motion_sampling.h"
#include "two_body_motion.h"

namespace sdf_ccd {
namespace {

constexpr double kRemainder = 0.0080187537388;  // √3/216: max |s (s − ½) (s − 1)| / 6 on [0, 1]

}  // namespace

/// Adds samples to one motion.
class MotionSampler::Run {
 public:
  Run(MotionSampler& memory, const MotionSource& source, const std::vector<std::size_t>& bodies, CycleMotion& motion)
      : memory_(memory), source_(source), balls_(memory.balls_), bodies_(bodies), motion_(motion) {}

  void add(double time, const std::vector<Isometry3d>& X_WB) {
    motion_.times.push_back(time);
    for (const std::size_t body : bodies_) motion_.X_WB[body].push_back(X_WB[body]);
  }

  /// Adds the samples after the last one, up to and with `end`. Samples are kept in order, so the first half goes
  /// first.
  void addUpTo(double end, const std::vector<Isometry3d>& X_end, int halvings_left) {
    cancel_.check();
    const double start = motion_.times.back(), middle = 0.5 * (start + end);
    std::vector<Isometry3d>& X_middle = memory_.X_middle_[static_cast<std::size_t>(halvings_left)];
    source_.poses_at(middle, X_middle);
    memory_.jerk_.assign(balls_.size(), kInfinity);
    source_.jerk_bounds(start, end, memory_.jerk_);
    memory_.deviation_.assign(balls_.size(), 0.0);
    double worst = 0.0;
    for (const std::size_t body : bodies_) {
      if (!motion_.missing[body].empty()) continue;
      memory_.deviation_[body] = deviation(body, X_middle[body], X_end[body]);
      worst = std::max(worst, memory_.deviation_[body]);
    }
    const MotionSampling& sampling = memory_.sampling_;
    const bool has_room = motion_.times.size() * bodies_.size() < sampling.max_poses;
    if (worst > sampling.tolerance && halvings_left > 0 && has_room && start < middle && middle < end) {
      addUpTo(middle, X_middle, halvings_left - 1);
      addUpTo(end, X_end, halvings_left - 1);
      return;
    }
    for (const std::size_t body : bodies_) {
      motion_.motion_error[body] = std::max(motion_.motion_error[body], memory_.deviation_[body]);
    }
    add(end, X_end);
  }

 private:
  /// Bound of a body's deviation from the screw between the last sample and the next one [m].
  double deviation(std::size_t body, const Isometry3d& X_middle, const Isometry3d& X_end) const {
    const Isometry3d& X_start = motion_.X_WB[body].back();
    const double jerk = memory_.jerk_[body];
    const bool rests = X_start.matrix() == X_end.matrix() && X_start.matrix() == X_middle.matrix();
    if (rests && jerk == 0.0) return 0.0;
    const ScrewMotion screw(X_start, X_end);
    const double bound =
        maxDisplacement(X_middle, screw.pose(0.5), balls_[body]) + kRemainder * (jerk + screw.maxJerk(balls_[body]));
    return std::isnan(bound) ? kInfinity : bound;
  }

  MotionSampler& memory_;
  const MotionSource& source_;
  const std::vector<BoundingBall>& balls_;
  const std::vector<std::size_t>& bodies_;
  CycleMotion& motion_;
  const CancelPoint cancel_;
};

MotionSampler::MotionSampler(std::vector<BoundingBall> balls, const MotionSampling& sampling)
    : balls_(std::move(balls)),
      all_(balls_.size()),
      sampling_(sampling),
      X_middle_(static_cast<std::size_t>(std::max(0, sampling.max_halvings)) + 1) {
  std::iota(all_.begin(), all_.end(), std::size_t{0});
}

void MotionSampler::add(const std::vector<double>& waypoints, const MotionSource& source,
                        const std::vector<std::size_t>& bodies, CycleMotion& motion) {
  motion.missing.resize(balls_.size());
  motion.X_WB.resize(balls_.size());
  motion.motion_error.resize(balls_.size(), 0.0);
  Run run(*this, source, bodies, motion);
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    source.poses_at(waypoints[i], X_end_);
    if (i == 0) {
      run.add(waypoints[i], X_end_);
    } else {
      run.addUpTo(waypoints[i], X_end_, static_cast<int>(X_middle_.size()) - 1);
    }
  }
}

void sampleMotion(const std::vector<double>& waypoints, const MotionSource& source,
                  const std::vector<BoundingBall>& balls, const MotionSampling& sampling, CycleMotion& motion) {
  motion.times.clear();
  motion.X_WB.resize(balls.size());
  for (auto& poses : motion.X_WB) poses.clear();
  motion.motion_error.assign(balls.size(), 0.0);
  MotionSampler(balls, sampling).add(waypoints, source, motion);
}

}  // namespace sdf_ccd
