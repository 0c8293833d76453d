#pragma once

#include "ros/world/changing_scene.h"

namespace sdf_ccd {

/// What does not change after start-up: the links, and what start-up left out.
struct ChangingScene::StartUp {
  std::shared_ptr<const RobotModel> robot;
  std::string tf_prefix, fixed_frame, tiles_begin;
  PairRules rules;
  RequestPermissions permissions;
  std::vector<std::string> objects;  // names
  std::vector<BodyDescription> links;
  std::set<std::string> link_names;  // of the robot, bodies or not
  std::vector<std::string> visual_only;
  std::vector<AllowedPair> allowed;
  std::vector<UnreachablePair> unreachable;
  std::vector<NamePair> unreachable_names;
  std::map<NamePair, std::string> proofs;  // of these: why they are left out if no rule is about them
  std::set<std::string> root_frames;       // rigidly joined to the root link
};

}  // namespace sdf_ccd
