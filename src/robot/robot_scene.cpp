#include "sdf_ccd/robot/robot_scene.h"

#include <optional>
#include <set>
#include <stdexcept>

#include "geometry_extent.h"
#include "link_geometry.h"
#include "sdf_ccd/robot/unreachable_pairs.h"

namespace sdf_ccd {
namespace {

using NamePair = std::pair<std::string, std::string>;

NamePair sorted(const std::string& a, const std::string& b) {
  return a < b ? NamePair(a, b) : NamePair(b, a);
}

/// Tells why a pair of links needs no check.
class PairFilter {
 public:
  PairFilter(const RobotModel& robot, const Srdf& srdf, const RobotSceneOptions& options)
      : robot_(robot), options_(options), mute_(srdf.disabled_by_default.begin(), srdf.disabled_by_default.end()) {
    for (const DisabledPair& pair : srdf.disabled) disabled_.emplace(sorted(pair.body_a, pair.body_b), pair.reason);
    for (const NamePair& pair : srdf.enabled) enabled_.insert(sorted(pair.first, pair.second));
  }

  /// @param ball_a  around A's geometry; none if its size is not known.
  std::string reason(const BodyDescription& a, const std::optional<ExtentBall>& ball_a, const BodyDescription& b,
                     const std::optional<ExtentBall>& ball_b) const {
    if (robot_.rigidlyJoined(a.name, b.name)) return "rigidly joined";
    const NamePair names = sorted(a.name, b.name);
    const auto disabled = disabled_.find(names);
    if (disabled != disabled_.end()) return disabled->second;
    if (!enabled_.count(names)) {
      if (mute_.count(a.name) || mute_.count(b.name)) return "SRDF: disabled by default";
      if (!options_.check_adjacent && robot_.adjacent(a.name, b.name)) return "adjacent";
    }
    if (ball_a && ball_b) {
      const auto reach = robot_.reach(a.name, ball_a->center, b.name, ball_b->center);
      if (reach.nearest > ball_a->radius + ball_b->radius) return kOutOfReach;
    }
    return {};
  }

 private:
  const RobotModel& robot_;
  const RobotSceneOptions& options_;
  std::set<std::string> mute_;
  std::map<NamePair, std::string> disabled_;
  std::set<NamePair> enabled_;
};

void warnOfUnknownLinks(const RobotModel& robot, const Srdf& srdf, std::vector<std::string>& warnings) {
  std::set<std::string> named(srdf.disabled_by_default.begin(), srdf.disabled_by_default.end());
  for (const DisabledPair& pair : srdf.disabled) named.insert({pair.body_a, pair.body_b});
  for (const NamePair& pair : srdf.enabled) named.insert({pair.first, pair.second});
  for (const std::string& link : robot.links()) named.erase(link);
  for (const std::string& link : named) warnings.push_back("the SRDF names link " + link + ", the URDF has none");
}

void warnOfVisualOnly(const std::vector<std::string>& links, std::vector<std::string>& warnings) {
  if (links.empty()) return;
  std::string text = links.size() == 1 ? "1 link has" : std::to_string(links.size()) + " links have";
  text += " a visual but no collision shape, and no contact of theirs is found:";
  for (const std::string& link : links) text += " " + link;
  warnings.push_back(text);
}

/// The link whose frame carries the body, if that never moves against the robot's root.
std::optional<Isometry3d> poseInRoot(const RobotModel& robot, const std::vector<Isometry3d>& X_RL,
                                     const BodyDescription& body) {
  for (std::size_t i = 0; i < X_RL.size(); ++i) {
    const std::string& link = robot.links()[i];
    if (link == body.frame && robot.rigidlyJoined(robot.root(), link)) return X_RL[i] * body.X_frame_B;
  }
  return std::nullopt;
}

/// True if the object, whose pose in the root's frame is X_RB, is farther from the link's ball than that can go.
bool outOfReach(const RobotModel& robot, const BodyDescription& object, const Isometry3d& X_RB, const std::string& link,
                const ExtentBall& ball) {
  const ExtentBall object_ball = extentBall(object.geometry);
  const auto between = robot.reach(robot.root(), X_RB * object_ball.center, link, ball.center);
  if (between.nearest > object_ball.radius + ball.radius) return true;
  // A wide object's ball holds much else; the object itself may lie beyond all that the link can reach.
  const auto from_root = robot.reach(robot.root(), Vector3d::Zero(), link, ball.center);
  const Vector3d p_B = X_RB.inverse().translation();
  return distanceBelow(object.geometry, p_B) > from_root.farthest + ball.radius;
}

}  // namespace

SceneDescription describeRobot(const RobotModel& robot, const Srdf& srdf, const ResourceLoader& loader,
                               const RobotSceneOptions& options, std::vector<std::string>& warnings) {
  SceneDescription scene;
  LinkGeometryLoader geometry(loader, warnings);
  for (const std::string& name : robot.links()) {
    const auto link = robot.urdf().getLink(name);
    const auto unread = robot.unread().find(name);
    if (link->collision_array.empty() && unread == robot.unread().end()) {
      if (!link->visual_array.empty()) scene.visual_only.push_back(name);
      continue;
    }
    BodyDescription body;
    body.name = name;
    body.frame = name;
    try {
      if (unread != robot.unread().end()) throw std::runtime_error(unread->second);
      body.geometry = geometry.load(*link);
    } catch (const std::exception& error) {
      body.failure = "link " + name + ": " + error.what();
    }
    scene.bodies.push_back(std::move(body));
  }
  if (scene.bodies.empty()) {
    warnings.push_back("robot " + robot.urdf().getName() + " has no link with a collision element");
  }
  warnOfVisualOnly(scene.visual_only, warnings);
  warnOfUnknownLinks(robot, srdf, warnings);

  std::vector<std::optional<ExtentBall>> balls;
  for (const BodyDescription& body : scene.bodies) {
    balls.push_back(body.failure.empty() ? std::make_optional(extentBall(body.geometry)) : std::nullopt);
  }
  const PairFilter filter(robot, srdf, options);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
      const std::string reason = filter.reason(scene.bodies[i], balls[i], scene.bodies[j], balls[j]);
      if (!reason.empty()) scene.disabled.push_back({scene.bodies[i].name, scene.bodies[j].name, reason});
    }
  }
  return scene;
}

void disableUnreachable(const RobotModel& robot, SceneDescription& scene) {
  std::set<NamePair> disabled;
  for (const DisabledPair& pair : scene.disabled) disabled.insert(sorted(pair.body_a, pair.body_b));
  const std::set<std::string> links(robot.links().begin(), robot.links().end());
  const std::vector<Isometry3d> X_RL = robot.forwardKinematics({});
  for (const BodyDescription& object : scene.bodies) {
    if (!object.is_world || !object.failure.empty() || object.geometry.empty()) continue;
    const std::optional<Isometry3d> X_RB = poseInRoot(robot, X_RL, object);
    if (!X_RB) continue;
    for (const BodyDescription& body : scene.bodies) {
      if (body.is_world || !body.failure.empty() || body.geometry.empty() || !links.count(body.name)) continue;
      if (disabled.count(sorted(object.name, body.name))) continue;
      std::string reason;
      if (robot.rigidlyJoined(robot.root(), body.name)) {
        reason = "rigidly joined";
      } else if (outOfReach(robot, object, *X_RB, body.name, extentBall(body.geometry))) {
        reason = kOutOfReach;
      }
      if (!reason.empty()) scene.disabled.push_back({body.name, object.name, reason});
    }
  }
}

}  // namespace sdf_ccd
