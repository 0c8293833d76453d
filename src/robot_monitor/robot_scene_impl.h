#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "robot/plan_from_now.h"
#include "robot/planned_motion.h"
#include "robot_monitor/check_motion.h"
#include "scene/pair_rules.h"
#include "sdf_ccd/robot_scene.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {

struct RobotScene::Impl {
  class StateDistances;

  /// An object of the world, or one that a link carries.
  struct Object {
    BodyDescription body;
    std::vector<std::string> may_touch, warnings;
  };

  Impl(RobotModel model, const Srdf& srdf, const ResourceLoader& mesh_loader, const RobotSceneOptions& options);

  /// Builds the first version of the scene.
  void build(const std::vector<WorldObject>& world, const Srdf& srdf, const RobotSceneOptions& options);

  /// Makes the next version of the scene, with these objects. If it throws, nothing is changed.
  void change(std::vector<Object> next);

  CurrentJoints jointsAt(const JointPositions& positions, const JointPoses& poses) const;
  Object objectOf(const WorldObject& object, const std::vector<std::string>& may_touch) const;
  std::vector<Object>::iterator find(std::vector<Object>& among, const std::string& name) const;

  const Scene& scene() const { return *world->scene; }
  const std::string& nameOf(int body) const { return scene().bodies[static_cast<std::size_t>(body)].name; }

  /// The motion of all bodies. @throws std::invalid_argument as RobotScene::check().
  PlannedMotion planned(const RobotTrajectory& trajectory, bool allow_beyond_limits, double tolerance) const;

  template <class Use>
  auto measured(const RobotState& state, const Use& use) const;

  const RobotModel robot;
  const ResourceLoader loader;
  const PairRules rules;
  const Forces forces;  // of all bodies
  MonitorOptions monitor;
  BodyOptions body_options;
  double sampling;  // tolerance of the bodies' sampled motions [m]

  SceneDescription links;                  // the robot's bodies, and their pairs that are left out
  std::vector<std::string> link_warnings;  // about the robot alone
  std::vector<Object> objects;
  PresentState now;  // joints: where setJoints() has them; bodies: of this version

  std::unique_ptr<WorldEditor> editor;
  std::shared_ptr<const WorldSnapshot> world;
  std::vector<std::string> warnings;      // about it
  std::shared_ptr<MonitorMemory> memory;  // of all checks

  mutable std::mutex idle_mutex;
  mutable std::vector<std::shared_ptr<StateDistances>> idle;  // of this version, and in no use

 private:
  SceneDescription describe(const std::vector<Object>& with, std::vector<std::string>& notes) const;
  void adopt(std::vector<Object> next, std::shared_ptr<const WorldSnapshot> version);
};

}  // namespace sdf_ccd
