#include "sdf_ccd/robot_scene.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "monitor/shared_memory.h"
#include "motion/screw_motion.h"
#include "motion/valid_pose.h"
#include "robot/object_body.h"
#include "robot/planned_motion.h"
#include "robot/robot_files.h"
#include "robot_monitor/overlapping_pairs.h"
#include "robot_monitor/robot_scene_impl.h"
#include "scene/body_options.h"
#include "scene/error_budget.h"
#include "scene/name_pair.h"
#include "scene/no_pairs.h"

namespace sdf_ccd {
namespace {

std::vector<PairRule> rulesOf(const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::vector<PairRule> rules;
  for (const auto& [a, b] : pairs) rules.push_back({a, b});
  return rules;
}

[[noreturn]] void refuseObject(const std::string& name, const std::string& why) {
  throw std::invalid_argument("object " + name + ": " + why);
}

void requireObjectPose(const std::string& name, const Isometry3d& X_frame_B) {
  requirePose(X_frame_B, "object " + name + ": its pose");
  if (!isNearOrigin(X_frame_B.translation())) refuseObject(name, "its pose is too far away");
}

/// Failures of reading name the body, those of building do not.
std::string failureByName(const Body& body) {
  return body.failure.find(body.name) == std::string::npos ? body.name + ": " + body.failure : body.failure;
}

void addOnce(const std::string& line, std::vector<std::string>& lines) {
  if (!line.empty() && std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
}

}  // namespace

RobotScene::Impl::Impl(RobotModel model, const Srdf& srdf, const ResourceLoader& mesh_loader,
                       const RobotSceneOptions& options)
    : robot(std::move(model)),
      loader(options.loader ? options.loader : mesh_loader),
      rules{rulesOf(options.allowed_pairs), rulesOf(options.checked_pairs)},
      forces(options.measure_contacts ? Forces::kKnown : Forces::kUnwanted),
      body_options(optionsForContacts(options.contact_spacing)),
      memory(makeMonitorMemory()) {
  monitor.contact = options.contact;
  monitor.max_error = options.max_error;
  sampling = samplingTolerance(monitor.max_error, monitor.chords.tolerance);
  setMotionErrors(sampling, monitor.chords.tolerance, body_options);
  body_options.cache_directory = options.cache_directory;
  // Refuses what no monitor takes before anything is built.
  [[maybe_unused]] const Monitor none(std::make_shared<const Scene>(), monitor);
  links = describeRobot(robot, srdf, loader, {options.check_adjacent}, link_warnings);
  for (BodyDescription& body : links.bodies) body.forces = forces;
  now.known_by = "setJoints()";
  now.joints = jointsAt({}, {});
}

void RobotScene::Impl::build(const std::vector<WorldObject>& first, const Srdf& srdf,
                             const RobotSceneOptions& options) {
  std::vector<Object> with;
  for (const WorldObject& object : first) with.push_back(objectOf(object, {}));
  SceneDescription description = describe(with, link_warnings);
  const std::size_t bodies_of_links = links.bodies.size(), allowed = description.allowed.size();
  const ScenePlan plan = planScene(description, planOptions(body_options));
  Scene built = buildScene(description, plan, body_options);
  const OverlapRule::Kind kind =
      options.check_overlapping_pairs ? OverlapRule::Kind::kCheck : OverlapRule::Kind::kNeighbours;
  applyOverlapRule(robot, overlapRule(kind, srdf, rules.checked), built);
  link_warnings.insert(link_warnings.end(), built.overlap_notes.begin(), built.overlap_notes.end());
  editor = std::make_unique<WorldEditor>(body_options);
  std::shared_ptr<const WorldSnapshot> version = editor->begin(std::move(description), plan, std::move(built));
  // Later versions leave out what building has left out.
  const SceneDescription& made = *version->description;
  for (std::size_t i = 0; i < bodies_of_links; ++i) links.bodies[i].failure = made.bodies[i].failure;
  for (std::size_t i = 0; i < with.size(); ++i) with[i].body.failure = made.bodies[bodies_of_links + i].failure;
  links.allowed.insert(links.allowed.end(), made.allowed.begin() + static_cast<std::ptrdiff_t>(allowed),
                       made.allowed.end());
  adopt(std::move(with), std::move(version));
}

/// The named joints, and those that follow them.
CurrentJoints RobotScene::Impl::jointsAt(const JointPositions& positions, const JointPoses& poses) const {
  const std::vector<Isometry3d> X_RL = robot.forwardKinematics(positions, poses);
  CurrentJoints current;
  for (int link = 1; link < static_cast<int>(X_RL.size()); ++link) {
    const urdf::Joint& joint = robot.jointAbove(link);
    const bool is_named =
        positions.count(joint.name) > 0 || positions.count(robot.leader(joint).name) > 0 || poses.count(joint.name) > 0;
    if (is_named) {
      const auto parent = static_cast<std::size_t>(robot.parent(link));
      current.X_PL[joint.name] = X_RL[parent].inverse() * X_RL[static_cast<std::size_t>(link)];
    } else {
      current.missing[joint.name] = "RobotScene::setJoints() does not name it";
    }
  }
  return current;
}

RobotScene::Impl::Object RobotScene::Impl::objectOf(const WorldObject& object,
                                                    const std::vector<std::string>& may_touch) const {
  if (const std::string why = whyNoName(object.name); !why.empty()) throw std::invalid_argument(why);
  if (robot.find(object.name) >= 0) refuseObject(object.name, "the robot has a link of this name");
  if (!object.frame.empty() && robot.find(object.frame) < 0)
    refuseObject(object.name, "the robot has no link \"" + object.frame + "\", its frame");
  if (object.shapes.empty()) refuseObject(object.name, "it has no shape");
  requireObjectPose(object.name, object.X_frame_B);
  Object made;
  made.body = toBody(object, object.frame, loader, made.warnings);
  made.body.is_attached = !object.frame.empty();
  made.body.is_world = !made.body.is_attached;
  made.body.forces = forces;
  made.may_touch = may_touch;
  return made;
}

std::vector<RobotScene::Impl::Object>::iterator RobotScene::Impl::find(std::vector<Object>& among,
                                                                       const std::string& name) const {
  const auto found =
      std::find_if(among.begin(), among.end(), [&](const Object& object) { return object.body.name == name; });
  if (found == among.end()) refuseObject(name, "there is none of this name");
  return found;
}

/// @param notes  receives a line for each pattern of the rules that matches no body's name.
SceneDescription RobotScene::Impl::describe(const std::vector<Object>& with, std::vector<std::string>& notes) const {
  SceneDescription description = links;
  for (const Object& object : with) description.bodies.push_back(object.body);
  for (const Object& object : with)
    for (const BodyDescription& other : description.bodies) {
      if (other.name == object.body.name) continue;
      for (const std::string& pattern : object.may_touch)
        if (matches(pattern, other.name))
          description.allowed.push_back({object.body.name, other.name, "allowed by may_touch"});
    }
  applyRules(rules, description, notes);
  setRigidRoots(robot, description);
  return description;
}

void RobotScene::Impl::change(std::vector<Object> next) {
  std::vector<std::string> notes;  // known from the first version
  std::shared_ptr<const WorldSnapshot> version = editor->next(describe(next, notes));
  adopt(std::move(next), std::move(version));
}

void RobotScene::Impl::adopt(std::vector<Object> next, std::shared_ptr<const WorldSnapshot> version) {
  std::vector<std::string> lines = link_warnings;
  for (const Object& object : next)
    for (const std::string& warning : object.warnings) addOnce(warning, lines);
  const Scene& scene = *version->scene;
  for (const Body& body : scene.bodies)
    if (!body.failure.empty()) addOnce("not checked: " + failureByName(body), lines);
  for (const BodyReport& report : scene.reports)
    for (const std::string& warning : report.warnings) addOnce(report.name + ": " + warning, lines);
  for (const std::string& warning : scene.warnings) addOnce(warning, lines);
  for (const std::string& warning : version->warnings) addOnce(warning, lines);
  addOnce(whyNoPairs(scene), lines);
  PlannedBodies carried = bodiesOf(scene, robot);
  idle.clear();
  warnings = std::move(lines);
  now.bodies = std::move(carried);
  objects = std::move(next);
  world = std::move(version);
}

RobotScene::RobotScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RobotScene::RobotScene(RobotScene&&) noexcept = default;
RobotScene& RobotScene::operator=(RobotScene&&) noexcept = default;
RobotScene::~RobotScene() = default;

RobotScene RobotScene::load(const std::string& urdf_file, const std::string& srdf_file,
                            const std::vector<WorldObject>& world, const RobotSceneOptions& options) {
  LoadedRobot robot = loadRobot(urdf_file, srdf_file);
  auto impl = std::make_unique<Impl>(std::move(robot.model), robot.srdf, std::move(robot.loader), options);
  impl->build(world, robot.srdf, options);
  return RobotScene(std::move(impl));
}

RobotScene RobotScene::parse(const std::string& urdf_xml, const std::string& srdf_xml,
                             const std::vector<WorldObject>& world, const RobotSceneOptions& options) {
  const Srdf srdf = srdf_xml.empty() ? Srdf() : parseSrdf(srdf_xml);
  auto impl = std::make_unique<Impl>(RobotModel(urdf_xml), srdf, localLoader({}), options);
  impl->build(world, srdf, options);
  return RobotScene(std::move(impl));
}

const RobotModel& RobotScene::robot() const {
  return impl_->robot;
}

const std::vector<std::string>& RobotScene::warnings() const {
  return impl_->warnings;
}

std::string RobotScene::planText() const {
  return planTable(impl_->scene());
}

std::vector<std::pair<std::string, std::string>> RobotScene::pairs() const {
  std::vector<std::pair<std::string, std::string>> names;
  for (const PlannedPair& pair : impl_->scene().pairs)
    names.emplace_back(impl_->nameOf(pair.body_a), impl_->nameOf(pair.body_b));
  return names;
}

void RobotScene::setJoints(const JointPositions& positions, const JointPoses& poses) {
  impl_->now.joints = impl_->jointsAt(positions, poses);
}

void RobotScene::addObject(const WorldObject& object, const std::vector<std::string>& may_touch) {
  Impl::Object made = impl_->objectOf(object, may_touch);
  if (!made.body.failure.empty()) throw std::invalid_argument(made.body.failure);
  std::vector<Impl::Object> next = impl_->objects;
  const auto same =
      std::find_if(next.begin(), next.end(), [&](const Impl::Object& known) { return known.body.name == object.name; });
  if (same == next.end())
    next.push_back(std::move(made));
  else
    *same = std::move(made);
  impl_->change(std::move(next));
}

void RobotScene::moveObject(const std::string& name, const Isometry3d& X_frame_B) {
  requireObjectPose(name, X_frame_B);
  std::vector<Impl::Object> next = impl_->objects;
  impl_->find(next, name)->body.X_frame_B = X_frame_B;
  impl_->change(std::move(next));
}

void RobotScene::removeObject(const std::string& name) {
  std::vector<Impl::Object> next = impl_->objects;
  next.erase(impl_->find(next, name));
  impl_->change(std::move(next));
}

std::vector<std::string> RobotScene::objects() const {
  std::vector<std::string> names;
  for (const Impl::Object& object : impl_->objects) names.push_back(object.body.name);
  return names;
}

}  // namespace sdf_ccd
