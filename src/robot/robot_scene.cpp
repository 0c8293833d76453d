#include "sdf_ccd/robot/robot_scene.h"

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>

#include "geometry_extent.h"
#include "link_geometry.h"
#include "model/name_pair.h"
#include "sdf_ccd/common/cancel.h"
#include "srdf_pairs.h"
#include "unreachable_pairs.h"

namespace sdf_ccd {
namespace {

/// Decides whether and why a pair of links needs no check.
class PairFilter {
 public:
  PairFilter(const RobotModel& robot, const Srdf& srdf, const RobotSceneOptions& options)
      : robot_(robot), options_(options), srdf_(srdf) {}

  /// @param ball_a  contains A's geometry; empty if its size is not known. The same for ball_b.
  std::string reason(const BodyDescription& a, const std::optional<BoundingBall>& ball_a, const BodyDescription& b,
                     const std::optional<BoundingBall>& ball_b) const {
    std::string disabled = srdf_.whyDisabled(a.name, b.name);
    if (!disabled.empty()) return disabled;
    if (robot_.rigidlyJoined(a.name, b.name)) return kRigidlyJoined;
    if (!srdf_.isEnabled(a.name, b.name)) {
      if (srdf_.isDisabledByDefault(a.name) || srdf_.isDisabledByDefault(b.name)) return "SRDF: disabled by default";
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
  SrdfPairs srdf_;
};

void warnOfVisualOnly(const std::vector<std::string>& links, std::vector<std::string>& warnings) {
  if (links.empty()) return;
  std::string text = links.size() == 1 ? "1 link has" : std::to_string(links.size()) + " links have";
  text += " a visual but no collision shape, so their contacts are not detected:";
  for (const std::string& link : links) text += " " + link;
  warnings.push_back(text);
}

/// The body's pose in the root's frame, if its frame is rigidly joined to the robot's root.
std::optional<Isometry3d> poseInRoot(const RobotModel& robot, const std::vector<Isometry3d>& X_RL,
                                     const BodyDescription& body) {
  for (std::size_t i = 0; i < X_RL.size(); ++i) {
    const std::string& link = robot.links()[i];
    if (link == body.frame && robot.rigidlyJoined(robot.root(), link)) return X_RL[i] * body.X_frame_B;
  }
  return std::nullopt;
}

/// True if the link's ball cannot reach the object, whose pose in the root's frame is X_RB.
bool outOfReach(const RobotModel& robot, const BodyDescription& object, const Isometry3d& X_RB, const std::string& link,
                const BoundingBall& ball) {
  const BoundingBall object_ball = extentBall(object.geometry);
  const auto between = robot.reach(robot.root(), X_RB * object_ball.center, link, ball.center);
  if (between.nearest > object_ball.radius + ball.radius) return true;
  // The ball of a wide object is much larger; the object itself may be beyond the reach of the link.
  const auto from_root = robot.reach(robot.root(), Vector3d::Zero(), link, ball.center);
  const Vector3d p_B = X_RB.inverse().translation();
  return distanceBelow(object.geometry, p_B) > from_root.farthest + ball.radius;
}

/// describeRobot() visits all pairs, and the joints between their links.
void requireFewPairs(const RobotModel& robot, std::size_t links) {
  constexpr std::size_t kMaxPairs = 300000;
  const std::size_t pairs = links * (links - std::min<std::size_t>(links, 1)) / 2;
  if (pairs <= kMaxPairs) return;
  throw std::length_error("robot " + robot.urdf().getName() + " has " + std::to_string(links) +
                          " links with collision elements, which are " + std::to_string(pairs) + " pairs; at most " +
                          std::to_string(kMaxPairs) + " can be checked");
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
  warnings.insert(warnings.end(), robot.warnings().begin(), robot.warnings().end());
  warnings.insert(warnings.end(), srdf.warnings.begin(), srdf.warnings.end());
  if (!srdf.robot.empty() && srdf.robot != robot.urdf().getName()) {
    warnings.push_back("the SRDF is of robot " + srdf.robot + ", the URDF of robot " + robot.urdf().getName() +
                       ": its allowed pairs may belong to another robot");
  }
  for (const std::string& link : unknownLinks(srdf, robot.links()))
    warnings.push_back("the SRDF names link " + link + ", which the URDF does not have");

  requireFewPairs(robot, scene.bodies.size());
  std::vector<std::optional<BoundingBall>> balls;
  for (const BodyDescription& body : scene.bodies) {
    balls.push_back(body.failure.empty() ? std::make_optional(extentBall(body.geometry)) : std::nullopt);
  }
  const PairFilter filter(robot, srdf, options);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    checkCancelled();
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
      const std::string reason = filter.reason(scene.bodies[i], balls[i], scene.bodies[j], balls[j]);
      if (reason.empty()) continue;
      const std::string &a = scene.bodies[i].name, &b = scene.bodies[j].name;
      scene.allowed.push_back({a, b, reason, isProof(reason) || robot.rigidlyJoined(a, b)});
    }
  }
  addProofs(robot, scene.bodies, scene.allowed);
  return scene;
}

void disableUnreachable(const RobotModel& robot, SceneDescription& scene) {
  std::set<NamePair> allowed;
  for (const AllowedPair& pair : scene.allowed) allowed.insert(namePair(pair.body_a, pair.body_b));
  const std::set<std::string> links(robot.links().begin(), robot.links().end());
  const std::vector<Isometry3d> X_RL = robot.forwardKinematics({});
  for (const BodyDescription& object : scene.bodies) {
    if (!object.is_world || !object.failure.empty() || object.geometry.empty()) continue;
    const std::optional<Isometry3d> X_RB = poseInRoot(robot, X_RL, object);
    if (!X_RB) continue;
    for (const BodyDescription& body : scene.bodies) {
      if (body.is_world || !body.failure.empty() || body.geometry.empty() || !links.count(body.name)) continue;
      if (allowed.count(namePair(object.name, body.name))) continue;
      std::string reason;
      if (robot.rigidlyJoined(robot.root(), body.name)) {
        reason = kRigidlyJoined;
      } else if (outOfReach(robot, object, *X_RB, body.name, extentBall(body.geometry))) {
        reason = kOutOfReach;
      }
      if (!reason.empty()) scene.allowed.push_back({body.name, object.name, reason, true});
    }
  }
  addProofs(robot, scene.bodies, scene.allowed);
}

}  // namespace sdf_ccd
