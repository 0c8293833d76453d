#include "joint_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/infinity.h"
#include "joint_kind.h"
#include "urdf_geometry.h"

namespace sdf_ccd {
namespace {

Vector3d unitAxis(const urdf::Joint& joint) {
  return toEigen(joint.axis).normalized();
}

}  // namespace

Isometry3d jointMotion(const urdf::Joint& joint, double position) {
  Isometry3d X = Isometry3d::Identity();
  if (rotates(joint)) {
    X.linear() = Eigen::AngleAxisd(position, unitAxis(joint)).toRotationMatrix();
  } else if (joint.type == urdf::Joint::PRISMATIC) {
    X.translation() = position * unitAxis(joint);
  }
  return X;
}

double jointPosition(const urdf::Joint& joint, const Isometry3d& X_JC) {
  if (joint.type == urdf::Joint::PRISMATIC) return X_JC.translation().dot(unitAxis(joint));
  if (!rotates(joint)) return std::numeric_limits<double>::quiet_NaN();
  constexpr double kRevolution = 6.283185307179586;
  const Quaterniond q(X_JC.linear());
  const double angle = std::remainder(2.0 * std::atan2(q.vec().dot(unitAxis(joint)), q.w()), kRevolution);
  if (joint.type == urdf::Joint::CONTINUOUS || !joint.limits) return angle;
  for (const double other : {angle, angle + kRevolution, angle - kRevolution}) {
    if (joint.limits->lower <= other && other <= joint.limits->upper) return other;
  }
  return angle;
}

Range reachRange(const urdf::ModelInterface& model, const urdf::Joint& joint) {
  constexpr double kShare = 0.1, kMin = 0.01;  // of the range, and [m]
  Range range(-kInfinity, kInfinity);
  if (hasLimits(joint)) {
    const double lower = joint.limits->lower, upper = joint.limits->upper;
    const double margin = std::max(kMin, kShare * (upper - lower));
    range = {lower - margin, upper + margin};
  }
  if (joint.mimic) {
    const Range leader = reachRange(model, *model.joints_.at(joint.mimic->joint_name));
    const double factor = joint.mimic->multiplier;
    const auto follow = [&](double q) { return (factor == 0.0 ? 0.0 : factor * q) + joint.mimic->offset; };
    range = std::minmax({range.first, range.second, follow(leader.first), follow(leader.second)});
  }
  return range;
}

void ChainReach::addFixed(const Isometry3d& X) {
  piece_.offset = X.linear().transpose() * (piece_.offset + X.translation());
  piece_.slide = X.linear().transpose() * piece_.slide;
  piece_.rotated_about = X.linear().transpose() * piece_.rotated_about;
}

void ChainReach::addJoint(const urdf::Joint& joint, const Range& range, bool forward) {
  switch (joint.type) {
    case urdf::Joint::FIXED:
      break;
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      cuts_.push_back({piece_, unitAxis(joint)});
      piece_ = Piece();
      piece_.rotated_about = unitAxis(joint);
      break;
    case urdf::Joint::PRISMATIC:
      if (!std::isfinite(range.first) || !std::isfinite(range.second)) {
        unlimited_ = true;
      } else if (!piece_.slides()) {
        piece_.slide = (forward ? 1.0 : -1.0) * unitAxis(joint);
        piece_.low = range.first;
        piece_.high = range.second;
      } else {
        further_slides_.push_back(std::max(std::abs(range.first), std::abs(range.second)));
      }
      break;
    default:  // floating, planar
      unlimited_ = true;
  }
}

double ChainReach::lengthOf(const Piece& piece) {
  return std::max((piece.offset + piece.low * piece.slide).norm(), (piece.offset + piece.high * piece.slide).norm());
}

double ChainReach::farthest(const Vector3d& end) const {
  if (unlimited_) return kInfinity;
  Piece last = piece_;
  last.offset += end;

  // A rotation about an end moves nothing.
  std::vector<Cut> cuts = cuts_;
  for (; !cuts.empty() && last.isPoint(); cuts.pop_back()) last = cuts.back().before;
  while (!cuts.empty() && cuts.front().before.isPoint()) cuts.erase(cuts.begin());

  const bool one_cut = cuts.size() == 1 && further_slides_.empty();
  if (one_cut && !last.slides() && !cuts[0].before.slides()) {
    // |v + R w|, R about the axis: the parts along it are fixed, those across it add up to anything in between.
    const Vector3d& v = cuts[0].before.offset;
    const Vector3d& w = last.offset;
    const double along = cuts[0].axis.dot(v) + last.rotated_about.dot(w);
    const double across_v = cuts[0].axis.cross(v).norm();
    const double across_w = last.rotated_about.cross(w).norm();
    return std::hypot(along, across_v + across_w);
  }

  double sum = lengthOf(last);
  for (const Cut& cut : cuts) sum += lengthOf(cut.before);
  for (const double length : further_slides_) sum += length;
  return sum;
}

}  // namespace sdf_ccd
