#include "ros/monitor/objects_in_map.h"

#include <algorithm>

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

/// Whether a frame is one of the robot's, and may move in the map.
bool ObjectsInMap::movesWithRobot(const std::string& frame) const {
  if (frame == frame_) return false;
  const BodyList& bodies = world_.scene().bodies;
  const bool is_of_robot = std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
    return !body.is_world && withoutLeadingSlash(body.frame) == frame;
  });
  const auto isStatic = [&](const std::string& name) {
    const TfSpan span = history_.span(name);
    return name == history_.fixedFrame() || (span.problem.empty() && span.is_static);
  };
  return is_of_robot && !(isStatic(frame) && isStatic(frame_));
}

bool ObjectsInMap::lookup(std::size_t object, const ros::Time& time, Isometry3d& X_BM) const {
  const TrackedBody& body = world_.bodies[object];
  Isometry3d X_WM, X_WF;
  std::string problem;
  if (!history_.lookup(frame_, time, X_WM, problem) ||
      !history_.lookup(withoutLeadingSlash(body.frame), time, X_WF, problem)) {
    return false;
  }
  X_BM = (X_WF * body.X_frame_B).inverse() * X_WM;
  return true;
}

std::vector<ObjectMask> ObjectsInMap::masks(
    const ros::Time& stamp, const std::function<bool(const std::string&, std::uint64_t)>& is_new) const {
  std::vector<ObjectMask> masks;
  for (const std::size_t b : objects()) {
    const Body& body = world_.scene().bodies[b];
    const auto attached = world_.attached_since.find(body.name);
    const bool is_attached = attached != world_.attached_since.end();
    Isometry3d X_BM;
    bool is_at_stamp = false;
    if (is_attached && is_new(body.name, declared(b))) {
      if (!lookup(b, attached->second, X_BM)) continue;  // later, when tf knows it
    } else {
      is_at_stamp = !stamp.isZero() && lookup(b, stamp, X_BM);
      if (!is_at_stamp && !lookup(b, ros::Time(), X_BM)) continue;
    }
    auto mask = objectMaskOf(body, world_.description().bodies[b], X_BM);
    if (!mask) continue;
    mask->name = body.name;
    mask->declared = declared(b);
    mask->is_attached = is_attached || movesWithRobot(withoutLeadingSlash(body.frame));
    mask->is_at_stamp = is_at_stamp;
    masks.push_back(std::move(*mask));
  }
  return masks;
}

}  // namespace sdf_ccd
