#pragma once

#include <map>
#include <string>
#include <vector>

#include "sdf_ccd/robot/robot_model.h"
#include "sdf_ccd/scene/scene_description.h"

namespace sdf_ccd {

/// What is used of an SRDF file.
struct Srdf {
  std::vector<DisabledPair> disabled;                       ///< reason: "SRDF: " and the file's
  std::map<std::string, JointPositions> states;             ///< "group/state"
};

/// @throws std::runtime_error, with line and reason, if the text is no SRDF.
Srdf parseSrdf(const std::string& xml);

}  // namespace sdf_ccd
