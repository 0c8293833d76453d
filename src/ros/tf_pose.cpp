#include "ros/tf_pose.h"

#include <algorithm>
#include <cmath>

#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {
namespace {

constexpr double kMaxNormError = 1e-2;   // of the squared length; tf2's
constexpr double kTinyHalfAngle = 1e-9;  // below it slerp's weights are those of a line [rad]

/// In [0, π/2]; from the difference and the sum, so that small angles are not lost as by the arc cosine of tf2.
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
  const Quaterniond rotation(q.w, q.x, q.y, q.z);
  const Vector3d translation(p.x, p.y, p.z);
  if (!translation.allFinite() || !rotation.coeffs().allFinite()) {
    pose.problem = "has a transform that is not finite";
  } else if (!(std::abs(rotation.squaredNorm() - 1.0) <= kMaxNormError)) {
    pose.problem = "has a rotation that is no unit quaternion";
  } else if (!(translation.lpNorm<Eigen::Infinity>() <= kFarthestPose)) {
    pose.problem = "is more than 1e+08 m from its parent";
  } else {
    pose.rotation = rotation.normalized();
    pose.translation = translation;
  }
  return pose;
}

bool isSamePlace(const TfPose& a, const TfPose& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs() && a.problem == b.problem;
}

double angleBetween(const TfPose& a, const TfPose& b) {
  return 2.0 * halfAngle(a.rotation, b.rotation);
}

Isometry3d interpolate(const TfPose& a, const TfPose& b, double share) {
  const Vector3d translation = a.translation + share * (b.translation - a.translation);
  if (a.rotation.coeffs() == b.rotation.coeffs()) return Eigen::Translation3d(translation) * a.rotation;
  const double theta = halfAngle(a.rotation, b.rotation);
  double weight_a = 1.0 - share, weight_b = share;
  if (theta > kTinyHalfAngle) {
    weight_a = std::sin(weight_a * theta) / std::sin(theta);
    weight_b = std::sin(weight_b * theta) / std::sin(theta);
  }
  if (a.rotation.dot(b.rotation) < 0.0) weight_b = -weight_b;
  const Quaterniond rotation(weight_a * a.rotation.coeffs() + weight_b * b.rotation.coeffs());
  return Eigen::Translation3d(translation) * rotation.normalized();
}

}  // namespace sdf_ccd
