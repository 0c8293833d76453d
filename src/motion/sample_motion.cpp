#include "sdf_ccd/motion/sample_motion.h"

#include <algorithm>
#include <limits>

#include "sdf_ccd/common/cancel.h"
#include "sdf_ccd/motion/two_body_motion.h"

namespace sdf_ccd {
namespace {

constexpr double kRemainder = 0.0080187537388;  // √3/216: max |s (s − ½) (s − 1)| / 6 on [0, 1]

class Sampler {
 public:
  Sampler(const MotionSource& source, const std::vector<BoundingBall>& balls, const MotionSampling& sampling,
          CycleMotion& motion)
      : source_(source), balls_(balls), sampling_(sampling), motion_(motion) {
    motion_.missing.resize(balls.size());
    motion_.X_WB.resize(balls.size());
    for (auto& poses : motion_.X_WB) poses.clear();
    motion_.times.clear();
    motion_.motion_error.assign(balls.size(), 0.0);
  }

  /// Adds the samples after the last one, up to and with `end`. Samples are kept in order, so the first half goes
  /// first.
  void addUpTo(double end, const std::vector<Isometry3d>& X_end, int halvings_left) {
    cancel_.check();
    const double start = motion_.times.back(), middle = 0.5 * (start + end);
    std::vector<Isometry3d> X_middle;
    source_.poses_at(middle, X_middle);
    jerk_.assign(balls_.size(), std::numeric_limits<double>::infinity());
    source_.jerk_bounds(start, end, jerk_);
    deviation_.assign(balls_.size(), 0.0);
    double worst = 0.0;
    for (std::size_t body = 0; body < balls_.size(); ++body) {
      if (!motion_.missing[body].empty()) continue;
      deviation_[body] = deviation(body, X_middle[body], X_end[body]);
      worst = std::max(worst, deviation_[body]);
    }
    const bool has_room = motion_.times.size() < sampling_.max_samples;
    if (worst > sampling_.tolerance && halvings_left > 0 && has_room && start < middle && middle < end) {
      addUpTo(middle, X_middle, halvings_left - 1);
      addUpTo(end, X_end, halvings_left - 1);
      return;
    }
    for (std::size_t body = 0; body < balls_.size(); ++body) {
      motion_.motion_error[body] = std::max(motion_.motion_error[body], deviation_[body]);
    }
    add(end, X_end);
  }

  void add(double time, const std::vector<Isometry3d>& X_WB) {
    motion_.times.push_back(time);
    for (std::size_t body = 0; body < balls_.size(); ++body) motion_.X_WB[body].push_back(X_WB[body]);
  }

 private:
  /// Between the last sample and the next one.
  double deviation(std::size_t body, const Isometry3d& X_middle, const Isometry3d& X_end) const {
    const Isometry3d& X_start = motion_.X_WB[body].back();
    const bool rests = X_start.matrix() == X_end.matrix() && X_start.matrix() == X_middle.matrix();
    if (rests && jerk_[body] == 0.0) return 0.0;
    const ScrewMotion screw(X_start, X_end);
    return maxDisplacement(X_middle, screw.pose(0.5), balls_[body]) +
           kRemainder * (jerk_[body] + screw.maxJerk(balls_[body]));
  }

  const MotionSource& source_;
  const std::vector<BoundingBall>& balls_;
  const MotionSampling& sampling_;
  CycleMotion& motion_;
  const CancelPoint cancel_;
  std::vector<double> jerk_;
  std::vector<double> deviation_;
};

}  // namespace

void sampleMotion(const std::vector<double>& waypoints, const MotionSource& source,
                  const std::vector<BoundingBall>& balls, const MotionSampling& sampling, CycleMotion& motion) {
  Sampler sampler(source, balls, sampling, motion);
  std::vector<Isometry3d> X_WB;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    source.poses_at(waypoints[i], X_WB);
    if (i == 0) {
      sampler.add(waypoints[i], X_WB);
    } else {
      sampler.addUpTo(waypoints[i], X_WB, sampling.max_halvings);
    }
  }
}

}  // namespace sdf_ccd
