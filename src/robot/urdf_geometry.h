#pragma once

#include <urdf_model/pose.h>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

inline Vector3d toEigen(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

inline Isometry3d toEigen(const urdf::Pose& pose) {
  const Quaterniond rotation(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
  return Eigen::Translation3d(toEigen(pose.position)) * rotation.normalized();
}

}  // namespace sdf_ccd
