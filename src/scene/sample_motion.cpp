#include "sdf_ccd/scene/sample_motion.h"

#include <algorithm>

namespace sdf_ccd {
namespace {

constexpr double kHalfSpaceRadius = 10.0;  // [m]

class Sampler {
 public:
  Sampler(const PosesAt& poses_at, const std::vector<BoundingBall>& balls, const MotionSampling& sampling,
          CycleMotion& motion)
      : poses_at_(poses_at), balls_(balls), sampling_(sampling), motion_(motion) {
    motion_.missing.resize(balls.size());
    motion_.X_WB.resize(balls.size());
    for (auto& poses : motion_.X_WB) poses.clear();
    motion_.times.clear();
    motion_.motion_error.assign(balls.size(), 0.0);
  }

  /// Adds the samples after `start`, up to and with `end`. Samples are kept in order, so the first half goes first.
  void addUpTo(double end, const std::vector<Isometry3d>& X_end, int halvings_left) {
    const double middle = 0.5 * (motion_.times.back() + end);
    std::vector<Isometry3d> X_middle;
    poses_at_(middle, X_middle);
    deviation_.assign(balls_.size(), 0.0);
    double worst = 0.0;
    for (std::size_t body = 0; body < balls_.size(); ++body) {
      if (!motion_.missing[body].empty()) continue;
      deviation_[body] = deviation(motion_.X_WB[body].back(), X_middle[body], X_end[body], balls_[body]);
      worst = std::max(worst, deviation_[body]);
    }
    if (worst > sampling_.tolerance && halvings_left > 0) {
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
  static double deviation(const Isometry3d& X_start, const Isometry3d& X_middle, const Isometry3d& X_end,
                          const BoundingBall& ball) {
    if (X_start.matrix() == X_end.matrix() && X_start.matrix() == X_middle.matrix()) return 0.0;
    const Isometry3d X_screw = ScrewMotion(X_start, X_end).pose(0.5);
    return ScrewMotion(X_middle, X_screw).maxTravel(ball);
  }

  const PosesAt& poses_at_;
  const std::vector<BoundingBall>& balls_;
  const MotionSampling& sampling_;
  CycleMotion& motion_;
  std::vector<double> deviation_;
};

}  // namespace

void sampleMotion(const std::vector<double>& knots, const PosesAt& poses_at, const std::vector<BoundingBall>& balls,
                  const MotionSampling& sampling, CycleMotion& motion) {
  Sampler sampler(poses_at, balls, sampling, motion);
  std::vector<Isometry3d> X_WB;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    poses_at(knots[i], X_WB);
    if (i == 0) {
      sampler.add(knots[i], X_WB);
    } else {
      sampler.addUpTo(knots[i], X_WB, sampling.max_halvings);
    }
  }
}

BoundingBall motionBall(const Body& body) {
  if (body.ball.radius > 0.0) return body.ball;
  AlignedBox3d box_B;
  for (const BodyPart& part : body.parts) {
    const AlignedBox3d& box_G = part.field.surfaceBox();
    if (!box_G.min().allFinite() || !box_G.max().allFinite()) return {Vector3d::Zero(), kHalfSpaceRadius};
    box_B.extend(box_G.transformed(part.X_BG));
  }
  if (box_B.isEmpty()) return {};
  return {box_B.center(), 0.5 * box_B.diagonal().norm()};
}

}  // namespace sdf_ccd
