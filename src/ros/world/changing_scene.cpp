#include "ros/world/changing_scene.h"

#include <algorithm>
#include <stdexcept>

#include "common/cancel_point.h"
#include "common/refuse.h"
#include "common/shown_text.h"
#include "common/text_limits.h"
#include "robot/object_body.h"
#include "ros/parameters/moveit_scene.h"
#include "ros/parameters/world_file.h"
#include "ros/world/changing_scene_start_up.h"
#include "ros/world/world_bodies.h"
#include "scene/name_pair.h"

namespace sdf_ccd {
namespace {

Isometry3d lookup(const TfHistory& history, const std::string& frame, const ros::Time& time) {
  Isometry3d X_WF;
  std::string problem;
  if (!history.lookup(frame, time, X_WF, problem)) refuse(problem);
  return X_WF;
}

/// Pose of a frame in another one at a time or, if that is 0, at the latest time at which both are known, as one may
/// lag behind.
Isometry3d poseOf(const TfHistory& history, const std::string& frame, const std::string& in, ros::Time time) {
  if (time.isZero()) {
    const TfSpan a = history.span(frame), b = history.span(in);
    if (a.problem.empty() && b.problem.empty() && !a.is_static && !b.is_static) time = std::min(a.last, b.last);
  }
  return lookup(history, in, time).inverse() * lookup(history, frame, time);
}

/// Counts the meshes of an object, also those from files, against the triangles that the call may still contain.
void countTriangles(const BodyDescription& body, std::size_t& triangles) {
  for (const GeometryDescription& part : body.geometry) {
    const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&part.shape);
    if (!mesh) continue;
    if ((*mesh)->triangles.size() > triangles) refuse(part.source + ": more triangles than one call may hold");
    triangles -= (*mesh)->triangles.size();
  }
}

/// What leaves an object where it is takes no pose, so that a pose has one meaning.
void requireNoPose(const SceneChange& change, const std::string& what) {
  if (hasPose(change))
    refuse(what + " leaves " + shownText(change.id) + " where it is: MOVE it first, and give no pose");
}

}  // namespace

ChangingScene::ChangingScene(const DescribedScene& described, const PairRules& rules, const SceneDescription& first,
                             const RequestPermissions& permissions) {
  auto start_up = std::make_shared<StartUp>();
  start_up->robot = described.robot;
  start_up->tf_prefix = described.tf_prefix;
  start_up->fixed_frame = described.fixed_frame;
  start_up->tiles_begin = described.tiles_begin;
  start_up->rules = rules;
  start_up->permissions = permissions;
  start_up->visual_only = first.visual_only;
  start_up->allowed = first.allowed;
  for (const BodyDescription& body : first.bodies) {
    if (!body.is_world) {
      start_up->links.push_back(body);
    } else if (!body.map.empty()) {
      setTiles({body}, {}, nullptr);  // the awaited map
    } else {
      objects_[body.name] = {body, "", {}, {}, ++added_, true, 0};
      start_up->objects.push_back(body.name);
    }
  }
  start_up_ = start_up;
}

void ChangingScene::apply(const SceneChange& change, ChangeSources& sources) {
  checkCancelled();
  settled_ = nullptr;
  if (change.operation <= SceneChange::DETACH) requireName(change.id, "the object's id", sources.limits);
  const RequestPermissions& permissions = start_up_->permissions;
  switch (change.operation) {
    case SceneChange::ADD:
      requireAddable(change.id, "ADD");
      return add(change, sources);
    case SceneChange::REMOVE:
      requireRemovable(change);
      return erase(change);
    case SceneChange::APPEND:
      requireReplaceable(change.id, "APPEND");
      return append(change, sources);
    case SceneChange::MOVE:
      requireReplaceable(change.id, "MOVE");
      return move(change);
    case SceneChange::ATTACH:
      requireAllowed(permissions.attach, "attach", "ATTACH");
      if (objects_.count(change.id) == 0 || hasShapes(change)) requireAddable(change.id, "ATTACH");
      if (objects_.count(change.id) > 0) permissions.requireUnprotected(change.id, "ATTACH");
      return attach(change, sources);
    case SceneChange::DETACH:
      requireAllowed(permissions.attach, "attach", "DETACH");
      if (frameOf(change, start_up_->fixed_frame) != start_up_->fixed_frame)
        requireAllowed(permissions.move, "move", "DETACH to a frame");
      permissions.requireUnprotected(change.id, "DETACH");
      return detach(change, sources);
    case SceneChange::ALLOW:
    case SceneChange::CHECK:
      requireAllowed(permissions.rules, "rules", change.operation == SceneChange::ALLOW ? "ALLOW" : "CHECK");
      return addRule(change, sources);
    case SceneChange::FORGET_RULES:
      requireAllowed(permissions.rules, "rules", "FORGET_RULES");
      return rules_.clear();
    case SceneChange::LOAD:
      return load(change, sources);
    default:
      refuse("unknown operation " + std::to_string(change.operation) + ", see SceneChange.msg");
  }
}

/// What moves or replaces an object takes away what protected the robot there; what it is extended by may lie in voxels
/// of a map, which are then judged as the object.
void ChangingScene::requireReplaceable(const std::string& name, const std::string& what) const {
  requireAllowed(start_up_->permissions.move, "move", what);
  start_up_->permissions.requireUnprotected(name, what);
}

void ChangingScene::requireAddable(const std::string& name, const std::string& what) const {
  if (objects_.count(name) > 0) return requireReplaceable(name, what + " in place of " + shownText(name));
  requireAllowed(start_up_->permissions.add, "add", what + " of " + shownText(name));
}

void ChangingScene::requireRemovable(const SceneChange& change) const {
  requireAllowed(start_up_->permissions.clear, "clear", "REMOVE");
  for (const auto& [name, object] : objects_)
    if (matches(change.id, name)) start_up_->permissions.requireUnprotected(name, "REMOVE");
}

void ChangingScene::set(BodyDescription body) {
  settled_ = nullptr;
  const auto known = objects_.find(body.name);
  const std::size_t order = known == objects_.end() ? ++added_ : known->second.order;
  const std::string name = body.name;
  objects_[name] = {std::move(body), "", {}, {}, order, false, ++declared_};
}

ChangingScene::Object& ChangingScene::find(const std::string& name) {
  const auto found = objects_.find(name);
  if (found == objects_.end()) refuse("there is no object " + shownText(name));
  return found->second;
}

/// The tf frame in the header of a change; `fallback` if it is empty.
std::string ChangingScene::frameOf(const SceneChange& change, const std::string& fallback) const {
  const std::string frame = withoutLeadingSlash(change.header.frame_id);
  if (frame.size() > RequestLimits().name || frame != shownText(frame))
    refuse(shownText(frame) + " is not a valid frame name");
  return frame.empty() ? fallback : frame;
}

/// The object without its pose.
BodyDescription ChangingScene::make(const SceneChange& change, ChangeSources& sources) const {
  const std::string frame = frameOf(change, start_up_->fixed_frame);
  WorldObject object{change.id, frame, Isometry3d::Identity(), shapesIn(change, sources.limits, sources.triangles)};
  const bool is_map = !change.octomap_file.empty();
  if (is_map && !object.shapes.empty())
    refuse("an object with octomap_file cannot have other shapes: add those as another object");
  if (is_map) object.shapes.push_back({OctomapObject{change.octomap_file}});
  if (object.shapes.empty()) refuse("object " + change.id + " has no shape");
  const ResourceLoader loader = [&](const std::string& name) {
    return is_map ? sources.files.read(name) : sources.files.resource(name);
  };
  const BodyDescription body = toBody(object, frame, loader, sources.warnings);
  if (!is_map) countTriangles(body, sources.triangles);
  if (!body.failure.empty()) refuse(body.failure);
  return body;
}

/// Throws unless an object may have this name.
void ChangingScene::requireUsableName(const std::string& name) const {
  if (const std::string why = whyNoName(name); !why.empty()) refuse(why);
  if (start_up_->robot->find(name) >= 0) refuse(name + " is a link of the robot");
  requireNoTile(name, start_up_->tiles_begin);
}

void ChangingScene::add(const SceneChange& change, ChangeSources& sources) {
  requireUsableName(change.id);
  BodyDescription body = make(change, sources);
  body.X_frame_B = poseIn(change.pose, "the pose");
  set(std::move(body));
}

void ChangingScene::move(const SceneChange& change) {
  Object& object = find(change.id);
  if (!object.link.empty())
    refuse(shownText(change.id) + " is attached to " + shownText(object.link) + ": DETACH it first");
  object.body.frame = frameOf(change, object.body.frame);
  object.body.X_frame_B = poseIn(change.pose, "the pose");
  object.is_unchanged = false;
  object.declared = ++declared_;
}

void ChangingScene::erase(const SceneChange& change) {
  if (!isPattern(change.id)) {
    find(change.id);
    objects_.erase(change.id);
    return;
  }
  for (auto object = objects_.begin(); object != objects_.end();)
    object = matches(change.id, object->first) ? objects_.erase(object) : std::next(object);
}

/// The object gets shapes, and stays where it is, attached or not.
void ChangingScene::append(const SceneChange& change, ChangeSources& sources) {
  Object& object = find(change.id);
  requireNoPose(change, "APPEND");
  if (const std::string frame = frameOf(change, object.body.frame); frame != object.body.frame)
    refuse("APPEND leaves " + shownText(change.id) + " in the frame " + object.body.frame +
           ", and its shapes are in the object's own: give no frame, instead of " + frame);
  const bool holds_map = std::any_of(object.body.geometry.begin(), object.body.geometry.end(),
                                     [](const GeometryDescription& part) { return part.watertight_voxels; });
  if (holds_map || !change.octomap_file.empty())
    refuse("an OctoMap is the only shape of its object: add others as another object");
  std::vector<GeometryDescription> parts = make(change, sources).geometry;
  if (object.body.geometry.size() + parts.size() > sources.limits.shapes)
    refuse(change.id + " would have more than " + std::to_string(sources.limits.shapes) + " shapes");
  std::move(parts.begin(), parts.end(), std::back_inserter(object.body.geometry));
  if (!object.link.empty()) object.attached_since = sources.now;  // voxels there were not the object's
  object.is_unchanged = false;
  object.declared = ++declared_;
}

void ChangingScene::attach(const SceneChange& change, ChangeSources& sources) {
  if (start_up_->robot->find(change.link_name) < 0) refuse("the robot has no link " + shownText(change.link_name));
  const std::string link_frame = start_up_->tf_prefix + change.link_name;
  if (objects_.count(change.id) == 0 || hasShapes(change)) {
    SceneChange made = change;
    if (made.header.frame_id.empty()) made.header.frame_id = link_frame;
    add(made, sources);
  } else {
    requireNoPose(change, "ATTACH without shapes");
  }
  Object& object = find(change.id);
  Isometry3d X_LB = object.body.X_frame_B;
  if (object.body.frame != link_frame)
    X_LB = poseOf(sources.history, object.body.frame, link_frame, change.header.stamp) * X_LB;
  if (change.touch_links.size() > sources.limits.rules)
    refuse("more than " + std::to_string(sources.limits.rules) + " touch_links");
  for (const std::string& touched : change.touch_links) {
    requireName(touched, "a touch_link", sources.limits);
    requireNoneProtected(touched, "touch_links");
  }
  const bool is_there = object.link == change.link_name && object.body.X_frame_B.matrix() == X_LB.matrix();
  if (!is_there) object.attached_since = change.header.stamp.isZero() ? sources.now : change.header.stamp;
  object.body.frame = link_frame;
  object.body.X_frame_B = X_LB;
  object.body.is_world = false;
  object.body.is_attached = true;
  object.link = change.link_name;
  object.touch_links = change.touch_links;
  object.is_unchanged = false;
}

void ChangingScene::detach(const SceneChange& change, ChangeSources& sources) {
  Object& object = find(change.id);
  if (object.link.empty()) refuse(change.id + " is not attached");
  requireNoPose(change, "DETACH");
  const std::string frame = frameOf(change, start_up_->fixed_frame);
  object.body.X_frame_B =
      poseOf(sources.history, object.body.frame, frame, change.header.stamp) * object.body.X_frame_B;
  object.body.frame = frame;
  object.body.is_world = true;
  object.body.is_attached = false;
  object.link.clear();
  object.attached_since = {};
  object.touch_links.clear();
}

/// The names of the scene's bodies that match a pattern; `visit` returns true to end.
template <class Visit>
bool ChangingScene::anyNamed(const std::string& pattern, const Visit& visit) const {
  const auto is_found = [&](const BodyDescription& body) { return matches(pattern, body.name) && visit(body.name); };
  return std::any_of(start_up_->links.begin(), start_up_->links.end(), is_found) ||
         (tiles_ && std::any_of(tiles_->begin(), tiles_->end(), is_found)) ||
         std::any_of(objects_.begin(), objects_.end(),
                     [&](const auto& object) { return is_found(object.second.body); });
}

void ChangingScene::requireNoneProtected(const std::string& pattern, const std::string& what) const {
  if (start_up_->permissions.protected_bodies.empty()) return;
  anyNamed(pattern, [&](const std::string& name) {
    start_up_->permissions.requireUnprotected(name, what + " " + shownText(pattern));
    return false;
  });
}

void ChangingScene::addRule(const SceneChange& change, ChangeSources& sources) {
  const RequestLimits& limits = sources.limits;
  for (const auto& [pattern, what] : {std::pair(change.body_a, "body_a"), std::pair(change.body_b, "body_b")}) {
    requireName(pattern, what, limits);
    if (change.operation == SceneChange::ALLOW) requireNoneProtected(pattern, "ALLOW");
    if (!anyNamed(pattern, [](const std::string&) { return true; }))
      sources.warnings.push_back("no body is named " + shownText(pattern) + ", yet");
  }
  const auto same = [&](const RequestRule& rule) {
    return namePair(rule.pair.a, rule.pair.b) == namePair(change.body_a, change.body_b);
  };
  rules_.erase(std::remove_if(rules_.begin(), rules_.end(), same), rules_.end());
  if (rules_.size() >= limits.rules)
    refuse("more than " + std::to_string(limits.rules) + " rules about pairs: remove them with FORGET_RULES");
  rules_.push_back({{change.body_a, change.body_b}, change.operation == SceneChange::ALLOW});
}

void ChangingScene::load(const SceneChange& change, ChangeSources& sources) {
  const ResourceLoader loader = [&](const std::string& uri) { return sources.files.resource(uri); };
  const Resource file = sources.files.read(change.file, kMaxYamlBytes);
  for (const WorldObject& object : parseWorldFile(file.bytes, file.name)) {
    checkCancelled();
    requireName(object.name, "an object's name", sources.limits);
    requireUsableName(object.name);
    requireAddable(object.name, "LOAD");
    const std::string frame = object.frame.empty() ? start_up_->fixed_frame : withoutLeadingSlash(object.frame);
    BodyDescription body = toBody(object, frame, loader, sources.warnings);
    if (!body.failure.empty()) refuse(body.failure);
    countTriangles(body, sources.triangles);
    set(std::move(body));
  }
}

std::vector<std::string> ChangingScene::objects() const {
  std::vector<std::string> names;
  for (const auto& [name, object] : objects_) names.push_back(name);
  return names;
}

std::map<std::string, ros::Time> ChangingScene::attachedSince() const {
  std::map<std::string, ros::Time> since;
  for (const auto& [name, object] : objects_)
    if (!object.link.empty()) since.emplace(name, object.attached_since);
  return since;
}

std::map<std::string, std::uint64_t> ChangingScene::declared() const {
  std::map<std::string, std::uint64_t> declared;
  for (const auto& [name, object] : objects_) declared.emplace(name, object.declared);
  return declared;
}

std::string ChangingScene::text(const ChangeSources& sources, std::vector<std::string>& warnings) const {
  std::vector<BodyDescription> bodies;
  for (const auto& [name, object] : objects_) {
    BodyDescription body = object.body;
    if (std::any_of(body.geometry.begin(), body.geometry.end(),
                    [](const auto& part) { return part.watertight_voxels; })) {
      warnings.push_back(name + " is not saved: it is an OctoMap, which .scene files cannot hold");
      continue;
    }
    if (!body.failure.empty()) {
      warnings.push_back(name + " is not saved, because it cannot be checked: " + body.failure);
      continue;
    }
    if (body.frame != start_up_->fixed_frame)
      body.X_frame_B = lookup(sources.history, body.frame, ros::Time()) * body.X_frame_B;
    bodies.push_back(std::move(body));
  }
  return moveitScene(bodies);
}

}  // namespace sdf_ccd
