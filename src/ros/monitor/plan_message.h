#pragma once

#include <string>

#include "ros/world/checked_world.h"
#include "sdf_ccd/Plan.h"

namespace sdf_ccd {

/// The pairs that are checked in a version of the world, and those that are left out.
Plan toPlan(const CheckedWorld& world, const std::string& fixed_frame, const ros::Time& now);

}  // namespace sdf_ccd
