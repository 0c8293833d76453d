#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// What is used of an SRDF file. Names are not compared with any robot here.
struct Srdf {
  std::vector<DisabledPair> disabled;                 ///< reason: "SRDF: " and the file's
  std::map<std::string, JointPositions> states;       ///< "group/state"; "state" where the file names no group
  std::vector<std::string> disabled_by_default;       ///< links that are checked against those of `enabled` alone
  std::map<std::string, std::string> virtual_joints;  ///< child link by name; parent frame and type are not used
  std::vector<std::pair<std::string, std::string>> enabled;  ///< overrides disabled_by_default, and adjacency
};

/// Reads `disable_collisions`, `disable_default_collisions`, `enable_collisions`, `group_state` and
/// `virtual_joint`. As in MoveIt, a
/// pair that is both disabled and enabled is disabled. Joints with several values in a state (planar, floating) are
/// left out of it.
/// @param source  where the text is from, for errors; may be empty.
/// @throws std::runtime_error, with source, line and reason, if the text is no SRDF.
Srdf parseSrdf(const std::string& xml, const std::string& source = {});

}  // namespace sdf_ccd
