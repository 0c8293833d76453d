#include "sdf_ccd/robot.h"

#include <algorithm>
#include <stdexcept>

#include "common/cancel_point.h"
#include "link_geometry.h"
#include "srdf_pairs.h"
#include "urdf_geometry.h"

namespace sdf_ccd {
namespace {

/// Adds the pairs of links that may touch. Of those that are rigidly joined only what the SRDF names.
void allowPairs(const RobotModel& robot, const SrdfPairs& srdf, const RobotPairOptions& options,
                SceneDescription& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    checkCancelled();
    for (std::size_t k = i + 1; k < scene.bodies.size(); ++k) {
      const std::string &a = scene.bodies[i].name, &b = scene.bodies[k].name;
      if (const std::string disabled = srdf.whyDisabled(a, b); !disabled.empty()) {
        scene.allowed.push_back({a, b, disabled, PairKind::kSrdf});
      } else if (robot.rigidlyJoined(a, b) || srdf.isEnabled(a, b)) {
        continue;
      } else if (srdf.isDisabledByDefault(a) || srdf.isDisabledByDefault(b)) {
        scene.allowed.push_back({a, b, "SRDF: disabled by default", PairKind::kSrdf});
      } else if (!options.check_adjacent && robot.adjacent(a, b)) {
        scene.allowed.push_back({a, b, "adjacent", PairKind::kAdjacent});
      }
    }
  }
}

void warnOfVisualOnly(const std::vector<std::string>& links, std::vector<std::string>& warnings) {
  if (links.empty()) return;
  std::string text = links.size() == 1 ? "1 link has" : std::to_string(links.size()) + " links have";
  text += " a visual but no collision shape, so their contacts are not detected:";
  for (const std::string& link : links) text += " " + link;
  warnings.push_back(text);
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
                               const RobotPairOptions& options, std::vector<std::string>& warnings) {
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
  allowPairs(robot, SrdfPairs(srdf), options, scene);
  setRigidRoots(robot, scene);
  return scene;
}

void setRigidRoots(const RobotModel& robot, SceneDescription& scene, const std::string& prefix) {
  for (BodyDescription& body : scene.bodies) {
    body.rigid_root.clear();
    body.X_root_frame.setIdentity();
    const bool is_of_robot = body.map.empty() && body.frame.compare(0, prefix.size(), prefix) == 0;
    int link = is_of_robot ? robot.find(body.frame.substr(prefix.size())) : -1;
    for (; link > 0 && robot.jointAbove(link).type == urdf::Joint::FIXED; link = robot.parent(link))
      body.X_root_frame = toEigen(robot.jointAbove(link).parent_to_joint_origin_transform) * body.X_root_frame;
    if (link >= 0 && (link == 0 || !body.is_world)) body.rigid_root = robot.links()[static_cast<std::size_t>(link)];
  }
}

}  // namespace sdf_ccd
