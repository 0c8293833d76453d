#pragma once

#include <cmath>

#include <tf2_msgs/TFMessage.h>

#include "sdf_ccd/types.h"

namespace sdf_ccd::test {

inline geometry_msgs::TransformStamped stampedTransform(const std::string& parent, const std::string& child,
                                                        double stamp, double x, double yaw = 0.0) {
  geometry_msgs::TransformStamped result;
  result.header.frame_id = parent;
  result.header.stamp = ros::Time(stamp);
  result.child_frame_id = child;
  result.transform.translation.x = x;
  result.transform.rotation.w = std::cos(0.5 * yaw);
  result.transform.rotation.z = std::sin(0.5 * yaw);
  return result;
}

inline geometry_msgs::TransformStamped stampedTransform(const std::string& parent, const std::string& child,
                                                        const ros::Time& stamp, const Quaterniond& rotation,
                                                        const Vector3d& translation) {
  geometry_msgs::TransformStamped result = stampedTransform(parent, child, 0.0, translation.x());
  result.header.stamp = stamp;
  result.transform.translation.y = translation.y();
  result.transform.translation.z = translation.z();
  result.transform.rotation.w = rotation.w();
  result.transform.rotation.x = rotation.x();
  result.transform.rotation.y = rotation.y();
  result.transform.rotation.z = rotation.z();
  return result;
}

inline tf2_msgs::TFMessage message(const std::vector<geometry_msgs::TransformStamped>& transforms) {
  tf2_msgs::TFMessage result;
  result.transforms = transforms;
  return result;
}

}  // namespace sdf_ccd::test
