#include "ros/messages/conversions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "common/refuse.h"
#include "monitor/pair_result.h"
#include "motion/valid_pose.h"

namespace sdf_ccd {
namespace {

ros::Time toTime(std::chrono::nanoseconds since_epoch) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(since_epoch.count()));
}

/// As start + ros::Duration(seconds), up to a nanosecond, in a quarter of the time: contacts have many points.
ros::Time timeAfter(const ros::Time& start, double seconds) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  if (!(std::abs(seconds) < 1.0)) return start + ros::Duration(seconds);
  const std::int64_t nsec = start.nsec + std::llrint(1e9 * seconds);
  if (nsec < 0 || nsec >= kSecond) return start + ros::Duration(seconds);
  ros::Time time;
  time.sec = start.sec;
  time.nsec = static_cast<std::uint32_t>(nsec);
  return time;
}

void setPointContact(const ContactPoint& point, const ros::Time& start, PointContact& message) {
  message.enter = timeAfter(start, point.enter);
  message.exit = timeAfter(start, point.exit);
  message.time = timeAfter(start, point.time);
  message.depth = point.depth;
  message.depth_error = point.depth_error;
  message.position = toPoint(point.p_W);
  message.normal = toVector3(point.normal_W);
}

/// @param names  of the two in their message, for errors.
template <class Point>
Isometry3d checkedPose(const Point& p, const geometry_msgs::Quaternion& q,
                       const std::pair<const char*, const char*>& names) {
  const auto [position, orientation] = names;
  const Quaterniond given(q.w, q.x, q.y, q.z);
  if (given.coeffs().isZero(0.0))
    refuse(std::string(orientation) + " is a quaternion of zeros: write " + orientation + ".w: 1");
  if (!isNearOrigin({p.x, p.y, p.z})) refuse(std::string(position) + " is not finite, or too far from the origin");
  const std::optional<Isometry3d> pose = poseOf({p.x, p.y, p.z}, given);
  if (!pose) refuse(std::string(orientation) + " is not a unit quaternion");
  return *pose;
}

/// Zero unless both bounds are known.
TimeInterval touchOf(const std::optional<Interval>& touch, const CycleContext& cycle) {
  TimeInterval message;
  if (!touch || !std::isfinite(touch->enter) || !std::isfinite(touch->exit)) return message;
  message.start = timeAfter(cycle.start, touch->enter);
  message.end = timeAfter(cycle.start, touch->exit);
  return message;
}

}  // namespace

Isometry3d toIsometry(const geometry_msgs::Pose& pose) {
  return checkedPose(pose.position, pose.orientation, {"position", "orientation"});
}

Isometry3d toIsometry(const geometry_msgs::Transform& transform) {
  return checkedPose(transform.translation, transform.rotation, {"translation", "rotation"});
}

Vector3d toEigen(const geometry_msgs::Point& point) {
  return {point.x, point.y, point.z};
}

geometry_msgs::Point toPoint(const Vector3d& p) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = p.z();
  return message;
}

geometry_msgs::Pose toPose(const Isometry3d& X) {
  const Quaterniond q(X.linear());
  geometry_msgs::Pose message;
  message.position = toPoint(X.translation());
  message.orientation.w = q.w();
  message.orientation.x = q.x();
  message.orientation.y = q.y();
  message.orientation.z = q.z();
  return message;
}

geometry_msgs::TransformStamped toTransformStamped(const TransformName& name, const Isometry3d& X_parent_child) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = name.stamp;
  message.header.frame_id = name.parent;
  message.child_frame_id = name.child;
  message.transform.translation = toVector3(X_parent_child.translation());
  message.transform.rotation = toPose(X_parent_child).orientation;
  return message;
}

geometry_msgs::Vector3 toVector3(const Vector3d& v) {
  geometry_msgs::Vector3 message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

geometry_msgs::Wrench toWrench(const Wrench& wrench) {
  geometry_msgs::Wrench message;
  message.force = toVector3(wrench.force);
  message.torque = toVector3(wrench.torque);
  return message;
}

ErrorBound toErrorBound(const ErrorSources& error) {
  ErrorBound message;
  message.total = error.total();
  message.chord = error.chord;
  message.gap = error.gap;
  return message;
}

bool touchesAtSamples(const PairResult& pair, const CycleContext& cycle) {
  if (!isTimed(pair)) return holdsSample({pair.deepest.time, pair.deepest.time}, cycle.samples);
  return std::any_of(pair.intervals.begin(), pair.intervals.end(),
                     [&](const Interval& interval) { return holdsSample(interval, cycle.samples); });
}

void setPairContact(const PairResult& pair, const CycleContext& cycle, PairContact& message) {
  message.body_a = cycle.scene.bodies[pair.body_a].name;
  message.body_b = cycle.scene.bodies[pair.body_b].name;
  message.verdict = numberOf(pair.verdict);
  message.reason = pair.reason;
  message.incomplete = pair.incomplete;
  message.checked_from = timeAfter(cycle.start, cycle.motion.times[pair.span.first]);
  message.checked_until = timeAfter(cycle.start, cycle.motion.times[pair.span.last]);
  message.intervals.resize(pair.intervals.size());
  for (std::size_t i = 0; i < pair.intervals.size(); ++i) {
    message.intervals[i].start = timeAfter(cycle.start, pair.intervals[i].enter);
    message.intervals[i].end = timeAfter(cycle.start, pair.intervals[i].exit);
  }
  message.measured = pair.measured;
  message.first_touch = touchOf(pair.first_touch, cycle);
  message.last_touch = touchOf(pair.last_touch, cycle);
  message.in_contact_at_samples = touchesAtSamples(pair, cycle);
  if (pair.intervals.empty()) {
    message.first_contact = ros::Time();
    message.deepest = PointContact();
  } else {
    message.first_contact = message.intervals.front().start;
    setPointContact(pair.deepest, cycle.start, message.deepest);
  }
  message.points.resize(pair.points.size());
  for (std::size_t i = 0; i < pair.points.size(); ++i) setPointContact(pair.points[i], cycle.start, message.points[i]);
  message.wrench_on_a = toWrench(pair.on_a_W);
  message.wrench_on_b = toWrench(pair.on_b_W);
  message.origin_a = toPoint(cycle.motion.pose(pair.body_a, pair.span.last).translation());
  message.origin_b = toPoint(cycle.motion.pose(pair.body_b, pair.span.last).translation());
  message.error_bound = toErrorBound(pair.error);
  message.contact_error_bound = pair.contact_error.total();
}

void setContact(const TrackedContact& contact, Contact& message) {
  message.id = contact.id;
  message.body_a = contact.body_a;
  message.body_b = contact.body_b;
  message.begins = contact.begins;
  message.ends = contact.ends;
  message.is_lost = contact.is_lost;
  message.verdict = numberOf(contact.verdict);
  message.begin = toTime(contact.begin);
  message.end = toTime(contact.end);
  message.cycles = contact.cycles;
  message.seen_at_samples = contact.seen_at_samples;
  setPointContact(contact.deepest, toTime(contact.deepest_origin), message.deepest);
  message.max_force = contact.max_force;
  message.error_bound = contact.error_bound;
  message.contact_error_bound = contact.contact_error;
}

}  // namespace sdf_ccd
