#include "ros/world/describe_scene.h"

#include <filesystem>
#include <map>
#include <stdexcept>

#include "common/files/regular_file.h"
#include "common/shown_text.h"
#include "robot/object_body.h"
#include "robot_monitor/awaited_tile.h"
#include "ros/parameters/world_file.h"

namespace sdf_ccd {
namespace {

/// tf ignores leading slashes.
void requireOwnFrames(const RobotFrames& frames) {
  std::map<std::string, std::string> link_of;  // by frame
  for (const std::string& link : frames.robot.links()) {
    const auto [first, is_new] = link_of.emplace(frames(link), link);
    if (is_new) continue;
    throw std::runtime_error("the links " + shownText(first->second) + " and " + shownText(link) +
                             " have the same tf frame, " + shownText(first->first));
  }
}

}  // namespace

DescribedScene describeScene(const MonitorParameters& parameters, const ResourceLoader& loader) {
  const auto robot = std::make_shared<const RobotModel>(parameters.urdf, parameters.urdf_source);
  const Srdf srdf = parameters.srdf.empty() ? Srdf() : parseSrdf(parameters.srdf, parameters.srdf_source);
  const std::string prefix = parameters.tf_prefix.empty() ? "" : parameters.tf_prefix + "/";

  DescribedScene described;
  described.robot = robot;
  described.root_frame = prefix + robot->root();
  described.tf_prefix = prefix;
  requireOwnFrames(described.frames());
  for (const auto& [name, child] : srdf.virtual_joints) {
    if (child == robot->root()) described.base_joint = name;
  }
  described.fixed_frame = parameters.fixed_frame.empty() ? described.root_frame : parameters.fixed_frame;
  described.scene = describeRobot(*robot, srdf, loader, parameters.robot, described.warnings);

  // In the core, the robot's frames have the names of its links; in tf they also have the prefix.
  const auto frameOf = [&](const std::string& frame) {
    const std::string resolved = frame.empty() ? described.fixed_frame : withoutLeadingSlash(frame);
    return resolved == described.root_frame ? robot->root() : resolved;
  };
  std::vector<WorldObject> world = parameters.world;
  if (!parameters.world_file.empty()) {
    const std::vector<WorldObject> from_file = loadWorldFile(parameters.world_file);
    world.insert(world.end(), from_file.begin(), from_file.end());
  }
  if (world.size() > kMaxObjects) {
    throw std::invalid_argument("world: " + std::to_string(world.size()) + " objects; at most " +
                                std::to_string(kMaxObjects) + " are allowed");
  }
  for (const WorldObject& object : world) {
    if (const std::string why = whyNoName(object.name); !why.empty()) throw std::invalid_argument(why);
    described.scene.bodies.push_back(toBody(object, frameOf(object.frame), loader, described.warnings));
  }
  if (parameters.octomap) {
    const auto read = [](const std::string& file) { return Resource{readNamedFile(file), file, ""}; };
    described.scene.bodies.push_back(
        toBody(*parameters.octomap, frameOf(parameters.octomap->frame), read, described.warnings));
  }
  for (const std::string& root : parameters.resource_roots) {
    std::error_code error;
    if (!std::filesystem::is_directory(root, error))
      described.warnings.push_back("resource_roots: the folder " + root + " does not exist, so requests cannot use it");
  }
  if (!parameters.live_map.topic.empty()) described.tiles_begin = std::string(kLiveMap) + "/";
  for (const BodyDescription& body : described.scene.bodies) requireNoTile(body.name, described.tiles_begin);
  if (!parameters.live_map.topic.empty()) {
    const std::string why = "no map has been received on " + parameters.live_map.topic + " yet";
    described.scene.bodies.push_back(awaitedTile(frameOf(""), why));
    described.scene.has_live_map = true;
  }
  applyRules(parameters.pairs, described.scene, described.warnings);
  std::vector<PairRule> limited;
  for (const PairLimit& limit : parameters.proximity.pairs) limited.push_back(limit.bodies);
  warnOfUnknown("pairs", limited, described.scene, described.warnings);
  described.overlap_rule = overlapRule(parameters.overlapping_pairs, srdf, parameters.pairs.checked);
  for (BodyDescription& body : described.scene.bodies) {
    if (!body.is_world || body.frame == robot->root()) body.frame = prefix + body.frame;
  }
  setRigidRoots(*robot, described.scene, prefix);
  return described;
}

StartUpScene startUpScene(const DescribedScene& described, const MonitorParameters& parameters,
                          const SceneDescription& scene) {
  return {described.robot, described.tf_prefix, described.tiles_begin, parameters.pairs, parameters.requests, scene};
}

std::shared_ptr<const Scene> buildDescribed(DescribedScene& described, const ScenePlan& plan,
                                            const BodyOptions& options,
                                            const std::function<void(const std::string&, double)>& progress) {
  Scene scene = buildScene(described.scene, plan, options, progress);
  described.overlaps = applyOverlapRule(*described.robot, described.overlap_rule, scene);
  return std::make_shared<const Scene>(std::move(scene));
}

}  // namespace sdf_ccd
