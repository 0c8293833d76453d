#include "ros/monitor/objects_in_map.h"

#include <algorithm>
#include <map>

namespace sdf_ccd {

std::vector<std::size_t> ObjectsInMap::objects() const {
  std::vector<std::size_t> objects;
  const BodyList& bodies = world_.scene().bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const bool is_object = bodies[b].is_world || world_.attached_since.count(bodies[b].name) > 0;
    if (is_object && bodies[b].map.empty() && bodies[b].failure.empty()) objects.push_back(b);
  }
  return objects;
}

std::uint64_t ObjectsInMap::declared(std::size_t object) const {
  const auto known = world_.declared.find(name(object));
  return known == world_.declared.end() ? 0 : known->second;
}

/// Whether a frame may move in the map with the robot: on the way from the frame up to where it meets the map's in tf
/// is one of the robot's.
bool ObjectsInMap::movesWithRobot(const std::string& frame) const {
  const std::vector<std::string> above_map = history_.framesAbove(frame_), above = history_.framesAbove(frame);
  const auto isAboveMap = [&](const std::string& name) {
    return name == frame_ || std::find(above_map.begin(), above_map.end(), name) != above_map.end();
  };
  const auto isOfRobot = [&](const std::string& name) {
    const BodyList& bodies = world_.scene().bodies;
    return std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
      return !body.is_world && withoutLeadingSlash(body.frame) == name;
    });
  };
  if (isAboveMap(frame)) return false;
  const auto meet = std::find_if(above.begin(), above.end(), isAboveMap);
  if (!isOfRobot(frame) && std::none_of(above.begin(), meet, isOfRobot)) return false;
  const auto isStatic = [&](const std::string& name) {
    const TfSpan span = history_.span(name);
    return name == history_.fixedFrame() || (span.problem.empty() && span.is_static);
  };
  return !(isStatic(frame) && isStatic(frame_));
}

/// Where the object is with its present pose in its frame. @param time  0: the latest that tf knows.
std::optional<ObjectMask> ObjectsInMap::maskAt(std::size_t object, const ros::Time& time) const {
  const TrackedBody& body = world_.bodies[object];
  Isometry3d X_WM, X_WF;
  std::string problem;
  if (!history_.lookup(frame_, time, X_WM, problem) ||
      !history_.lookup(withoutLeadingSlash(body.frame), time, X_WF, problem)) {
    return std::nullopt;
  }
  return objectMaskOf(world_.scene().bodies[object], world_.description().bodies[object],
                      (X_WF * body.X_frame_B).inverse() * X_WM);
}

/// Of an object that was attached at a time, and is new to the map: where it was then and still is.
std::optional<ObjectMask> ObjectsInMap::graspedMask(std::size_t object, const ros::Time& attached) const {
  const std::optional<ObjectMask> then = maskAt(object, attached);
  std::optional<ObjectMask> mask = maskAt(object, ros::Time());
  if (!then || !mask) return std::nullopt;  // later, when tf knows it
  mask->isWithin = [was_within = then->isWithin, is_within = mask->isWithin](const Vector3d& p_M, double limit) {
    return was_within(p_M, limit) && is_within(p_M, limit);
  };
  return mask;
}

std::vector<ObjectMask> ObjectsInMap::masks(
    const ros::Time& stamp, const std::function<bool(const std::string&, std::uint64_t)>& is_new) const {
  std::vector<ObjectMask> masks;
  std::map<std::string, bool> moves;  // with the robot, by frame
  for (const std::size_t b : objects()) {
    const Body& body = world_.scene().bodies[b];
    const auto attached = world_.attached_since.find(body.name);
    const bool is_attached = attached != world_.attached_since.end();
    std::optional<ObjectMask> mask;
    bool is_at_stamp = false;
    if (is_attached && is_new(body.name, declared(b))) {
      mask = graspedMask(b, attached->second);
    } else {
      if (!stamp.isZero()) mask = maskAt(b, is_attached ? std::max(stamp, attached->second) : stamp);
      is_at_stamp = mask.has_value();
      if (!mask) mask = maskAt(b, ros::Time());
    }
    const auto [of_frame, is_first] = moves.try_emplace(withoutLeadingSlash(body.frame));
    if (is_first) of_frame->second = movesWithRobot(of_frame->first);
    const bool moves_with_robot = is_attached || of_frame->second;
    if (!mask && !moves_with_robot) continue;
    if (!mask) mask.emplace();
    mask->name = body.name;
    mask->declared = declared(b);
    mask->is_attached = moves_with_robot;
    mask->is_at_stamp = is_at_stamp;
    masks.push_back(std::move(*mask));
  }
  return masks;
}

}  // namespace sdf_ccd
