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
  std::vector<std::string> visual_only;
  std::vector<PairDecision> allowed;
};

}  // namespace sdf_ccd
