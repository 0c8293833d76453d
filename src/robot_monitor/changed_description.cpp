// The description of a changing scene: its bodies, and the pairs that may touch.

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "common/cancel_point.h"
#include "common/counted.h"
#include "robot/joint_chain.h"
#include "robot_monitor/changing_scene.h"
#include "scene/name_pair.h"

namespace sdf_ccd {

RuleIndex ChangingScene::ruleIndex() const {
  return {rules_, start_up_->permissions, settled_ ? settled_->matches : nullptr};
}

/// Whether touch_links allow an object that has changed since start-up and another body to touch.
bool ChangingScene::mayTouch(const ChangingObject& object, const BodyDescription& other) const {
  const std::string& name = object.body.name;
  const auto known = objects_.find(other.name);
  const std::string& other_link = known == objects_.end() ? other.name : known->second.link;
  const auto isLink = [&](const std::string& link) { return start_up_->robot->find(link) >= 0; };
  if (!isLink(object.link) || !isLink(other_link)) return false;
  const auto isNamed = [](const std::vector<std::string>& patterns, const std::string& touched) {
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const auto& pattern) { return matches(pattern, touched); });
  };
  checkCancelled();
  return (isNamed(object.touch_links, other.name) ||
          (known != objects_.end() && isNamed(known->second.touch_links, name))) &&
         !start_up_->permissions.isProtected(name) && !start_up_->permissions.isProtected(other.name);
}

/// Whether a body is neither a link nor an object that is as it was at start-up.
bool ChangingScene::hasChanged(const std::string& body) const {
  const auto object = objects_.find(body);
  return object == objects_.end() ? start_up_->robot->find(body) < 0 : !object->second.is_unchanged;
}

/// Whether a tile's voxels are those of an object that is still where it was: its pairs are checked instead. An object
/// that is changed or removed leaves its voxels to the map in the same version of the scene.
bool ChangingScene::isJudgedAsObject(const BodyDescription& tile) const {
  const auto judged = tile_objects_->find(tile.name);
  if (judged == tile_objects_->end()) return false;
  const auto object = objects_.find(judged->second.object);
  if (object == objects_.end() || object->second.declared != judged->second.declared) return false;
  // What requests have put into a protected map takes nothing of it from the checks.
  const bool is_of_requests = object->second.declared > 0;
  return object->second.body.failure.empty() && !(is_of_requests && start_up_->permissions.isProtected(tile.name));
}

/// Whether no grasp has the bodies touch, though touch_links allow it: more than two joints move between their links,
/// and neither is a part of the hand that holds the other.
bool ChangingScene::isNoGrasp(const PairDecision& pair) const {
  constexpr std::size_t kNearJoints = 2;
  const RobotModel& robot = *start_up_->robot;
  const auto linkOf = [&](const std::string& body) {
    const auto object = objects_.find(body);
    return robot.find(object == objects_.end() ? body : object->second.link);
  };
  const auto isInHand = [&](const std::string& object, int link) {
    int hand = objects_.count(object) > 0 ? linkOf(object) : 0;
    while (hand > 0 && robot.jointAbove(hand).type == urdf::Joint::FIXED) hand = robot.parent(hand);
    return hand > 0 && isBelow(robot, link, hand);
  };
  const int a = linkOf(pair.body_a), b = linkOf(pair.body_b);
  return jointsThatMove(robot, a, b).size() > kNearJoints && !isInHand(pair.body_a, b) && !isInHand(pair.body_b, a);
}

/// Adds the pairs that were left out at start-up, of bodies that have not changed since, unless a rule has them
/// checked.
void ChangingScene::keepAllowed(RuleIndex& rules, std::vector<PairDecision>& allowed) const {
  for (const PairDecision& pair : start_up_->scene.allowed) {
    if (hasChanged(pair.body_a) || hasChanged(pair.body_b)) continue;
    const RequestRule* rule = rules.last(pair.body_a, pair.body_b);
    if (!rule || rule->is_allowed) allowed.push_back(pair);
  }
}

/// Adds a pair to the allowed ones, if a rule says so: the last one of requests, touch_links, or those of the
/// parameters. @param a, b  null if the body is no object.
void ChangingScene::leaveOut(const BodyDescription& body_a, const ChangingObject* a, const BodyDescription& body_b,
                             const ChangingObject* b, RuleIndex& rules, std::vector<PairDecision>& allowed) const {
  if (body_a.is_world && body_b.is_world) return;
  const bool is_tile = !body_b.map.empty();
  const bool is_new = (a && !a->is_unchanged) || (b && !b->is_unchanged);
  if (!is_new && rules_.empty() && (!is_tile || start_up_->rules.allowed.empty())) return;
  const auto add = [&](const std::string& text, PairKind kind) {
    if (!text.empty()) allowed.push_back({body_a.name, body_b.name, text, kind});
  };
  if (const RequestRule* rule = rules.last(body_a.name, body_b.name)) {
    if (rule->is_allowed) add("update_scene: " + pairName(rule->pair.a, rule->pair.b), PairKind::kRequest);
  } else if (is_new && (b && !b->is_unchanged ? mayTouch(*b, body_a) : mayTouch(*a, body_b))) {
    add("attached, and allowed by touch_links", PairKind::kTouchLinks);
  } else if (is_new || is_tile) {
    add(whyAllowed(start_up_->rules, body_a.name, body_b.name), PairKind::kUser);
  }
}

/// @param bodies   without tiles.
/// @param objects  per body; null if it is none.
std::shared_ptr<const ChangingScene::Settled> ChangingScene::settle(
    const std::vector<BodyDescription>& bodies, const std::vector<const ChangingObject*>& objects) const {
  auto settled = std::make_shared<Settled>();
  RuleIndex rules = ruleIndex();
  keepAllowed(rules, settled->allowed);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    checkCancelled();
    for (std::size_t k = i + 1; k < bodies.size(); ++k)
      leaveOut(bodies[i], objects[i], bodies[k], objects[k], rules, settled->allowed);
  }
  settled->matches = std::make_shared<const RuleIndex::Known>(std::move(rules).found());
  return settled;
}

SceneDescription ChangingScene::description(const RequestLimits& limits) const {
  if (objects_.size() > limits.objects)
    throw std::length_error("more than " + std::to_string(limits.objects) + " objects");
  SceneDescription scene;
  scene.visual_only = start_up_->scene.visual_only;
  scene.has_live_map = !start_up_->tiles_begin.empty();
  scene.bodies = start_up_->scene.bodies;
  std::vector<const ChangingObject*> objects(scene.bodies.size(), nullptr);  // per body
  for (const auto& [name, object] : objects_) objects.push_back(&object);
  std::sort(objects.begin() + static_cast<std::ptrdiff_t>(scene.bodies.size()), objects.end(),
            [](const ChangingObject* a, const ChangingObject* b) { return a->order < b->order; });
  for (std::size_t i = scene.bodies.size(); i < objects.size(); ++i) scene.bodies.push_back(objects[i]->body);
  for (BodyDescription& body : scene.bodies) {
    const auto known = body.forces == Forces::kAwaited ? forces_.find(body.name) : forces_.end();
    if (known != forces_.end()) body.forces = known->second;
  }
  const auto moving = static_cast<std::size_t>(std::count_if(
      scene.bodies.begin(), scene.bodies.end(), [](const BodyDescription& body) { return !body.is_world; }));
  if (moving * objects.size() > limits.pairs)  // tiles do not count: no request may keep a map out
    throw std::length_error("more than " + std::to_string(limits.pairs) + " pairs");
  if (!settled_) settled_ = settle(scene.bodies, objects);
  scene.allowed = settled_->allowed;

  if (tiles_)
    std::copy_if(tiles_->begin(), tiles_->end(), std::back_inserter(scene.bodies),
                 [&](const BodyDescription& tile) { return !isJudgedAsObject(tile); });
  RuleIndex rules = ruleIndex();
  for (std::size_t k = objects.size(); k < scene.bodies.size(); ++k) {
    checkCancelled();
    for (std::size_t i = 0; i < objects.size(); ++i)
      leaveOut(scene.bodies[i], objects[i], scene.bodies[k], nullptr, rules, scene.allowed);
  }
  setRigidRoots(*start_up_->robot, scene, start_up_->link_prefix);
  return scene;
}

std::string ChangingScene::weakened(const SceneDescription& description) const {
  std::size_t pairs = 0;
  std::string first;
  const auto uses_patterns = [&](const std::string& body) {
    const auto object = objects_.find(body);
    return object != objects_.end() &&
           std::any_of(object->second.touch_links.begin(), object->second.touch_links.end(), isPattern);
  };
  for (const PairDecision& pair : description.allowed) {
    const bool by_touch_links = pair.kind == PairKind::kTouchLinks &&
                                (uses_patterns(pair.body_a) || uses_patterns(pair.body_b) || isNoGrasp(pair));
    if (!by_touch_links && pair.kind != PairKind::kRequest) continue;
    if (pairs++ == 0) first = pairName(pair.body_a, pair.body_b);
  }
  std::string text;
  if (pairs > 0) text = "requests allow " + counted(pairs, "pair") + " to touch, for example " + first;
  std::vector<std::string> changed;
  for (const std::string& name : first_objects_)
    if (hasChanged(name)) changed.push_back(name);
  if (!changed.empty()) {
    text += (text.empty() ? "requests have" : ", and have") + std::string(" removed, moved, replaced or attached ") +
            counted(changed.size(), "object") + " of the parameters, for example " + changed.front();
  }
  return text;
}

}  // namespace sdf_ccd
