#include "robot_monitor/changing_scene.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "common/counted.h"
#include "common/refuse.h"
#include "common/shown_text.h"
#include "robot/object_body.h"
#include "robot_monitor/awaited_tile.h"
#include "scene/name_pair.h"
#include "sdf_ccd/cancel.h"

namespace sdf_ccd {

ChangingScene::ChangingScene(StartUpScene start_up) {
  std::vector<BodyDescription> links;
  for (BodyDescription& body : start_up.scene.bodies) {
    if (!body.is_world) {
      links.push_back(std::move(body));
    } else if (!body.map.empty()) {
      setTiles({std::move(body)}, {}, nullptr);  // the awaited map
    } else {
      first_objects_.push_back(body.name);
      ChangingObject& object = objects_[body.name];
      object.body = std::move(body);
      object.order = ++added_;
      object.is_unchanged = true;
    }
  }
  start_up.scene.bodies = std::move(links);
  start_up_ = std::make_shared<const StartUpScene>(std::move(start_up));
}

const ChangingObject& ChangingScene::object(const std::string& name) const {
  const auto found = objects_.find(name);
  if (found == objects_.end()) refuse("there is no object " + shownText(name));
  return found->second;
}

ChangingObject& ChangingScene::find(const std::string& name) {
  object(name);
  settled_ = nullptr;
  return objects_.at(name);
}

void ChangingScene::requireAddable(const std::string& name, const std::string& what) const {
  if (const std::string why = whyNoName(name); !why.empty()) refuse(why);
  if (start_up_->robot->find(name) >= 0) refuse(name + " is a link of the robot");
  requireNoTile(name, start_up_->tiles_begin);
  if (objects_.count(name) > 0) return requireReplaceable(name, what + " in place of " + shownText(name));
  requireAllowed(permissions().add, "add", what + " of " + shownText(name));
}

/// What moves or replaces an object takes away what protected the robot there; what it is extended by may lie in voxels
/// of a map, which are then judged as the object.
void ChangingScene::requireReplaceable(const std::string& name, const std::string& what) const {
  requireAllowed(permissions().move, "move", what);
  permissions().requireUnprotected(name, what);
}

void ChangingScene::add(BodyDescription body) {
  settled_ = nullptr;
  const auto known = objects_.find(body.name);
  const std::size_t order = known == objects_.end() ? ++added_ : known->second.order;
  const std::string name = body.name;
  ChangingObject& object = objects_[name] = {};
  object.body = std::move(body);
  object.order = order;
  object.declared = ++declared_;
}

void ChangingScene::move(const std::string& name, const std::string& frame, const Isometry3d& X_frame_B) {
  ChangingObject& object = find(name);
  if (!object.link.empty()) refuse(shownText(name) + " is attached to " + shownText(object.link) + ": DETACH it first");
  if (!frame.empty()) object.body.frame = frame;
  object.body.X_frame_B = X_frame_B;
  object.is_unchanged = false;
  object.declared = ++declared_;
}

void ChangingScene::remove(const std::string& pattern) {
  requireAllowed(permissions().clear, "clear", "REMOVE");
  for (const auto& [name, object] : objects_)
    if (matches(pattern, name)) permissions().requireUnprotected(name, "REMOVE");
  if (!isPattern(pattern)) object(pattern);
  settled_ = nullptr;
  for (auto object = objects_.begin(); object != objects_.end();)
    object = matches(pattern, object->first) ? objects_.erase(object) : std::next(object);
}

void ChangingScene::append(const std::string& name, std::vector<GeometryDescription> parts,
                           std::chrono::nanoseconds now) {
  ChangingObject& object = find(name);
  std::move(parts.begin(), parts.end(), std::back_inserter(object.body.geometry));
  if (!object.link.empty()) object.attached_since = now;  // voxels there were not the object's
  object.is_unchanged = false;
  object.declared = ++declared_;
}

void ChangingScene::attach(const std::string& name, const Attachment& to, const RequestLimits& limits) {
  permissions().requireUnprotected(name, "ATTACH");
  if (to.touch_links.size() > limits.rules) refuse("more than " + std::to_string(limits.rules) + " touch_links");
  for (const std::string& touched : to.touch_links) {
    requireName(touched, "a touch_link", limits);
    requireNoneProtected(touched, "touch_links");
  }
  ChangingObject& object = find(name);
  const bool is_there = object.link == to.link && object.body.X_frame_B.matrix() == to.X_LB.matrix();
  if (!is_there) object.attached_since = to.since;
  object.body.frame = frameOf(to.link);
  object.body.X_frame_B = to.X_LB;
  object.body.is_world = false;
  object.body.is_attached = true;
  object.link = to.link;
  object.touch_links = to.touch_links;
  object.is_unchanged = false;
}

void ChangingScene::detach(const std::string& name, const std::string& frame, const Isometry3d& X_frame_B) {
  permissions().requireUnprotected(name, "DETACH");
  ChangingObject& object = find(name);
  object.body.frame = frame;
  object.body.X_frame_B = X_frame_B;
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
  const std::vector<BodyDescription>& links = start_up_->scene.bodies;
  return std::any_of(links.begin(), links.end(), is_found) ||
         (tiles_ && std::any_of(tiles_->begin(), tiles_->end(), is_found)) ||
         std::any_of(objects_.begin(), objects_.end(),
                     [&](const auto& object) { return is_found(object.second.body); });
}

void ChangingScene::requireNoneProtected(const std::string& pattern, const std::string& what) const {
  if (permissions().protected_bodies.empty()) return;
  anyNamed(pattern, [&](const std::string& name) {
    permissions().requireUnprotected(name, what + " " + shownText(pattern));
    return false;
  });
}

void ChangingScene::addRule(const RequestRule& added, const RequestLimits& limits, std::vector<std::string>& warnings) {
  const auto& [a, b] = added.pair;
  for (const auto& [pattern, what] : {std::pair(a, "body_a"), std::pair(b, "body_b")}) {
    requireName(pattern, what, limits);
    if (added.is_allowed) requireNoneProtected(pattern, "ALLOW");
    if (!anyNamed(pattern, [](const std::string&) { return true; }))
      warnings.push_back("no body is named " + shownText(pattern) + ", yet");
  }
  const auto same = [&](const RequestRule& rule) {
    return namePair(rule.pair.a, rule.pair.b) == namePair(added.pair.a, added.pair.b);
  };
  settled_ = nullptr;
  rules_.erase(std::remove_if(rules_.begin(), rules_.end(), same), rules_.end());
  if (rules_.size() >= limits.rules)
    refuse("more than " + std::to_string(limits.rules) + " rules about pairs: remove them with FORGET_RULES");
  rules_.push_back(added);
}

void ChangingScene::forgetRules() {
  settled_ = nullptr;
  rules_.clear();
}

void ChangingScene::setTiles(std::vector<BodyDescription> tiles, TileObjects objects, std::shared_ptr<MapAge> age) {
  tiles_ = std::make_shared<const std::vector<BodyDescription>>(std::move(tiles));
  tile_objects_ = std::make_shared<const TileObjects>(std::move(objects));
  map_age_ = std::move(age);
}

void ChangingScene::setTilesOf(const ChangingScene& other) {
  tiles_ = other.tiles_;
  tile_objects_ = other.tile_objects_;
  map_age_ = other.map_age_;
}

void ChangingScene::setForces(const std::vector<std::string>& bodies, Forces forces) {
  for (const std::string& body : bodies) forces_[body] = forces;
}

}  // namespace sdf_ccd
