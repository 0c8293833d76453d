#pragma once

#include <urdf_model/joint.h>

namespace sdf_ccd {

inline bool rotates(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
}

/// Rotates or translates: it has one position.
inline bool hasPosition(const urdf::Joint& joint) {
  return rotates(joint) || joint.type == urdf::Joint::PRISMATIC;
}

/// Equal limits mean that none were given.
inline bool hasLimits(const urdf::Joint& joint) {
  return joint.type != urdf::Joint::CONTINUOUS && joint.limits && joint.limits->lower != joint.limits->upper;
}

}  // namespace sdf_ccd
