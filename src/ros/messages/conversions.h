#pragma once

#include <string>
#include <vector>

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <ros/time.h>

#include "sdf_ccd/Contact.h"
#include "sdf_ccd/ErrorBound.h"
#include "sdf_ccd/PairContact.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// @throws std::invalid_argument if a number is not finite or too large, or the orientation is not a unit quaternion.
Isometry3d toIsometry(const geometry_msgs::Pose& pose);
Isometry3d toIsometry(const geometry_msgs::Transform& transform);

Vector3d toEigen(const geometry_msgs::Point& point);
geometry_msgs::Point toPoint(const Vector3d& p);
geometry_msgs::Pose toPose(const Isometry3d& X);

/// Header of a transform: the pose of frame `child` in frame `parent`.
struct TransformName {
  ros::Time stamp;
  std::string parent, child;
};
geometry_msgs::TransformStamped toTransformStamped(const TransformName& name, const Isometry3d& X_parent_child);

geometry_msgs::Vector3 toVector3(const Vector3d& v);
geometry_msgs::Wrench toWrench(const Wrench& wrench);

/// Data that the results of a cycle refer to.
struct CycleContext {
  const Scene& scene;
  const CycleMotion& motion;
  const std::vector<double>& samples;  ///< times of the recorded poses [s] from the motion's start
  ros::Time start;                     ///< of the motion
};

/// Whether the pair touches at one of the recorded times.
bool touchesAtSamples(const PairResult& pair, const CycleContext& cycle);

/// The number of a verdict in messages; see Verdict.msg.
constexpr std::uint8_t numberOf(Verdict verdict) {
  return static_cast<std::uint8_t>(verdict);
}

/// The bound of a verdict, which has no other sources: surfaces decide.
ErrorBound toErrorBound(const ErrorSources& error);

/// Sets all fields of the message, whose memory is reused; so do all functions named set….
void setPairContact(const PairResult& pair, const CycleContext& cycle, PairContact& message);

void setContact(const TrackedContact& contact, Contact& message);

/// Sets the pairs that are neither clear nor delayed and for which isListed(pair), called in their order, is true.
template <class IsListed>
void setPairContacts(const CycleResult& result, const CycleContext& cycle, const IsListed& isListed,
                     std::vector<PairContact>& messages) {
  std::size_t count = 0;
  for (const int i : result.not_clear) {
    const PairResult& pair = result.pairs[i];
    if (!isListed(pair)) continue;
    if (count == messages.size()) messages.emplace_back();
    setPairContact(pair, cycle, messages[count++]);
  }
  messages.resize(count);
}

}  // namespace sdf_ccd
