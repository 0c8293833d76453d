#include "ros/world/apply_change.h"

#include <algorithm>
#include <stdexcept>

#include "common/cancel_point.h"
#include "common/refuse.h"
#include "common/shown_text.h"
#include "common/text_limits.h"
#include "robot/moveit_scene.h"
#include "robot/object_body.h"
#include "ros/parameters/world_file.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

Isometry3d lookup(const TfHistory& history, const std::string& frame, const ros::Time& time) {
  Isometry3d X_WF;
  std::string problem;
  if (!history.lookup(frame, time, X_WF, problem)) refuse(problem);
  return X_WF;
}

/// Pose of an object in another frame at a time or, if that is 0, at the latest time at which both are known, as one
/// may lag behind.
Isometry3d poseOf(const TfHistory& history, const BodyDescription& body, const std::string& in, ros::Time time) {
  if (time.isZero()) {
    const TfSpan a = history.span(body.frame), b = history.span(in);
    if (a.problem.empty() && b.problem.empty() && !a.is_static && !b.is_static) time = std::min(a.last, b.last);
  }
  return lookup(history, in, time).inverse() * lookup(history, body.frame, time) * body.X_frame_B;
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

/// The tf frame in the header of a change; `fallback` if it is empty.
std::string frameOf(const SceneChange& change, const std::string& fallback) {
  const std::string frame = withoutLeadingSlash(change.header.frame_id);
  if (frame.size() > RequestLimits().name || frame != shownText(frame))
    refuse(shownText(frame) + " is not a valid frame name");
  return frame.empty() ? fallback : frame;
}

/// The object of a change, without its pose.
BodyDescription bodyOf(const SceneChange& change, const std::string& frame, ChangeSources& sources) {
  WorldObject object{change.id, frame, Isometry3d::Identity(), shapesIn(change, sources.limits, sources.triangles)};
  const bool is_map = !change.octomap_file.empty();
  if (is_map && !object.shapes.empty())
    refuse("an object with octomap_file cannot have other shapes: add those as another object");
  if (is_map) object.shapes.push_back({OctomapObject{change.octomap_file}});
  if (object.shapes.empty()) refuse("object " + change.id + " has no shape");
  const ResourceLoader loader = [&](const std::string& name) {
    return is_map ? sources.files.read(name) : sources.files.resource(name);
  };
  BodyDescription body = toBody(object, frame, loader, sources.warnings);
  if (!is_map) countTriangles(body, sources.triangles);
  if (!body.failure.empty()) refuse(body.failure);
  return body;
}

void add(const SceneChange& change, const std::string& frame, ChangeSources& sources, ChangingScene& scene) {
  BodyDescription body = bodyOf(change, frame, sources);
  body.X_frame_B = poseIn(change.pose, "the pose");
  scene.add(std::move(body));
}

void append(const SceneChange& change, ChangeSources& sources, ChangingScene& scene) {
  scene.requireReplaceable(change.id, "APPEND");
  const BodyDescription& body = scene.object(change.id).body;
  const std::vector<GeometryDescription>& shapes = body.geometry;
  requireNoPose(change, "APPEND");
  if (const std::string frame = frameOf(change, body.frame); frame != body.frame)
    refuse("APPEND leaves " + shownText(change.id) + " in the frame " + body.frame +
           ", and its shapes are in the object's own: give no frame, instead of " + frame);
  const bool holds_map =
      std::any_of(shapes.begin(), shapes.end(), [](const GeometryDescription& part) { return part.watertight_voxels; });
  if (holds_map || !change.octomap_file.empty())
    refuse("an OctoMap is the only shape of its object: add others as another object");
  std::vector<GeometryDescription> parts = bodyOf(change, "", sources).geometry;
  if (shapes.size() + parts.size() > sources.limits.shapes)
    refuse(change.id + " would have more than " + std::to_string(sources.limits.shapes) + " shapes");
  scene.append(change.id, std::move(parts), sinceEpoch(sources.now));
}

void attach(const SceneChange& change, ChangeSources& sources, ChangingScene& scene) {
  requireAllowed(scene.permissions().attach, "attach", "ATTACH");
  const bool is_added = scene.objects().count(change.id) == 0 || hasShapes(change);
  if (is_added) scene.requireAddable(change.id, "ATTACH");
  if (scene.robot().find(change.link_name) < 0) refuse("the robot has no link " + shownText(change.link_name));
  const std::string link_frame = scene.frameOf(change.link_name);
  if (is_added) {
    add(change, frameOf(change, link_frame), sources, scene);
  } else {
    requireNoPose(change, "ATTACH without shapes");
  }
  const BodyDescription& body = scene.object(change.id).body;
  const Isometry3d X_LB =
      body.frame == link_frame ? body.X_frame_B : poseOf(sources.history, body, link_frame, change.header.stamp);
  const ros::Time since = change.header.stamp.isZero() ? sources.now : change.header.stamp;
  scene.attach(change.id, {change.link_name, X_LB, change.touch_links, sinceEpoch(since)}, sources.limits);
}

void detach(const SceneChange& change, ChangeSources& sources, ChangingScene& scene) {
  const RequestPermissions& permissions = scene.permissions();
  requireAllowed(permissions.attach, "attach", "DETACH");
  const std::string& fixed = sources.history.fixedFrame();
  const std::string frame = frameOf(change, fixed);
  if (frame != fixed) requireAllowed(permissions.move, "move", "DETACH to a frame");
  const ChangingObject& object = scene.object(change.id);
  if (object.link.empty()) refuse(change.id + " is not attached");
  requireNoPose(change, "DETACH");
  scene.detach(change.id, frame, poseOf(sources.history, object.body, frame, change.header.stamp));
}

void load(const SceneChange& change, ChangeSources& sources, ChangingScene& scene) {
  const ResourceLoader loader = [&](const std::string& uri) { return sources.files.resource(uri); };
  const Resource file = sources.files.read(change.file, kMaxYamlBytes);
  for (const WorldObject& object : parseWorldFile(file.bytes, file.name)) {
    checkCancelled();
    requireName(object.name, "an object's name", sources.limits);
    scene.requireAddable(object.name, "LOAD");
    const std::string frame = object.frame.empty() ? sources.history.fixedFrame() : withoutLeadingSlash(object.frame);
    BodyDescription body = toBody(object, frame, loader, sources.warnings);
    if (!body.failure.empty()) refuse(body.failure);
    countTriangles(body, sources.triangles);
    scene.add(std::move(body));
  }
}

}  // namespace

void apply(const SceneChange& change, ChangeSources& sources, ChangingScene& scene) {
  checkCancelled();
  if (change.operation <= SceneChange::DETACH) requireName(change.id, "the object's id", sources.limits);
  const bool is_allow = change.operation == SceneChange::ALLOW;
  switch (change.operation) {
    case SceneChange::ADD:
      scene.requireAddable(change.id, "ADD");
      return add(change, frameOf(change, sources.history.fixedFrame()), sources, scene);
    case SceneChange::REMOVE:
      return scene.remove(change.id);
    case SceneChange::APPEND:
      return append(change, sources, scene);
    case SceneChange::MOVE:
      scene.requireReplaceable(change.id, "MOVE");
      return scene.move(change.id, frameOf(change, ""), poseIn(change.pose, "the pose"));
    case SceneChange::ATTACH:
      return attach(change, sources, scene);
    case SceneChange::DETACH:
      return detach(change, sources, scene);
    case SceneChange::ALLOW:
    case SceneChange::CHECK:
      requireAllowed(scene.permissions().rules, "rules", is_allow ? "ALLOW" : "CHECK");
      return scene.addRule({{change.body_a, change.body_b}, is_allow}, sources.limits, sources.warnings);
    case SceneChange::FORGET_RULES:
      requireAllowed(scene.permissions().rules, "rules", "FORGET_RULES");
      return scene.forgetRules();
    case SceneChange::LOAD:
      return load(change, sources, scene);
    default:
      refuse("unknown operation " + std::to_string(change.operation) + ", see SceneChange.msg");
  }
}

std::string sceneText(const ChangingScene& scene, const TfHistory& history, std::vector<std::string>& warnings) {
  std::vector<BodyDescription> bodies;
  for (const auto& [name, object] : scene.objects()) {
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
    if (body.frame != history.fixedFrame()) body.X_frame_B = lookup(history, body.frame, ros::Time()) * body.X_frame_B;
    bodies.push_back(std::move(body));
  }
  return moveitScene(bodies);
}

}  // namespace sdf_ccd
