#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/body.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// A body of the world without geometry.
BodyDescription emptyWorldBody(const std::string& name, const std::string& frame, const Isometry3d& X_frame_B);

/// Why an object cannot have this name; empty if it can.
std::string whyNoName(const std::string& name);

/// Body of an object in a frame. If it cannot be made, BodyDescription::failure says why.
/// @param warnings  receives other notes.
BodyDescription toBody(const WorldObject& object, const std::string& frame, const ResourceLoader& loader,
                       std::vector<std::string>& warnings);

}  // namespace sdf_ccd
