#include "ros/tf/tf_pose.h"

#include <algorithm>
#include <cmath>

#include "motion/valid_pose.h"

namespace sdf_ccd {
namespace {

constexpr double kTinyHalfAngle = 1e-9;  // below it slerp's weights are linear in double precision [rad]

/// Half the rotation angle, in [0, π/2], from |a - b| and |a + b|: the arc cosine that tf2 uses loses small angles.
double halfAngle(const Quaterniond& a, const Quaterniond& b) {
  const double difference = (a.coeffs() - b.coeffs()).norm(), sum = (a.coeffs() + b.coeffs()).norm();
  return 2.0 * std::atan2(std::min(difference, sum), std::max(difference, sum));
}

}  // namespace

TfPose toTfPose(const ros::Time& stamp, const geometry_msgs::Transform& transform) {
  TfPose pose;
  pose.stamp = stamp;
  const auto& q = transform.rotation;
  const auto& p = transform.translation;
  const Quaterniond given(q.w, q.x, q.y, q.z);
  const std::optional<Quaterniond> rotation = unitRotation(given);
  const Vector3d translation(p.x, p.y, p.z);
  if (!translation.allFinite() || !given.coeffs().allFinite()) {
    pose.problem = "has a transform that is not finite";
  } else if (!rotation) {
    pose.problem = "has a rotation that is no unit quaternion";
  } else if (!isNearOrigin(translation)) {
    pose.problem = "is more than 1e+08 m from its parent";
  } else {
    pose.rotation = *rotation;
    pose.translation = translation;
  }
  return pose;
}

bool isSamePose(const TfPose& a, const TfPose& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs() && a.problem == b.problem;
}

TfInterpolation::TfInterpolation(const TfPose& a, const TfPose& b)
    : a_(a.rotation), b_(b.rotation), from_(a.translation), displacement_(b.translation - a.translation) {
  if (a_.coeffs() == b_.coeffs()) return;
  half_angle_ = halfAngle(a_, b_);
  if (half_angle_ > kTinyHalfAngle) inverse_sine_ = 1.0 / std::sin(half_angle_);
  if (a_.dot(b_) < 0.0) b_.coeffs() = -b_.coeffs();
}

Isometry3d TfInterpolation::at(double share) const {
  const Vector3d translation = from_ + share * displacement_;
  if (half_angle_ == 0.0) return Eigen::Translation3d(translation) * a_;
  double weight_a = 1.0 - share, weight_b = share;
  if (inverse_sine_ > 0.0) {
    weight_a = std::sin(weight_a * half_angle_) * inverse_sine_;
    weight_b = std::sin(weight_b * half_angle_) * inverse_sine_;
  }
  const Quaterniond rotation(weight_a * a_.coeffs() + weight_b * b_.coeffs());
  return Eigen::Translation3d(translation) * rotation.normalized();
}

}  // namespace sdf_ccd
