// The description of a changing scene: its bodies, and the pairs that it leaves out.

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "common/counted.h"
#include "robot/joint_chain.h"
#include "ros/world/changing_scene_start_up.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

const std::string kTouchLinks = "attached, and allowed by touch_links";

std::string textOf(const RequestRule& rule) {
  return "update_scene: " + pairName(rule.pair.a, rule.pair.b);
}

}  // namespace

RuleIndex ChangingScene::ruleIndex() const {
  return {rules_, start_up_->permissions};
}

/// Why the pair of an object that has changed since start-up and another body, not both of the world, is left out;
/// empty if it is checked.
/// @param proved  receives whether they are rigidly joined: without a rule that allows them to touch, they are watched
/// instead of checked.
std::string ChangingScene::whyLeftOut(const Object& object, const BodyDescription& other, bool& proved) const {
  const std::string& name = object.body.name;
  const auto known = objects_.find(other.name);
  const std::string& other_link = known == objects_.end() ? other.name : known->second.link;
  const auto isLink = [&](const std::string& link) { return start_up_->link_names.count(link) > 0; };
  const bool are_of_robot = isLink(object.link) && isLink(other_link);
  const bool is_static = start_up_->root_frames.count(object.body.frame) > 0 || object.body.frame == other.frame;
  proved = (are_of_robot && start_up_->robot->rigidlyJoined(object.link, other_link)) ||
           (object.link.empty() && is_static && start_up_->root_frames.count(other.frame) > 0);
  const auto mayTouch = [](const std::vector<std::string>& patterns, const std::string& touched) {
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const auto& pattern) { return matches(pattern, touched); });
  };
  const bool may_touch = mayTouch(object.touch_links, other.name) ||
                         (known != objects_.end() && mayTouch(known->second.touch_links, name));
  const RequestPermissions& permissions = start_up_->permissions;
  const bool is_protected = permissions.isProtected(name) || permissions.isProtected(other.name);
  if (are_of_robot && may_touch && !is_protected) return kTouchLinks;
  const std::string allowed = whyAllowed(start_up_->rules, name, other.name);
  return allowed.empty() && proved ? kRigidlyJoined : allowed;
}

/// Whether a body is neither a link nor an object that is as it was at start-up.
bool ChangingScene::hasChanged(const std::string& body) const {
  const auto object = objects_.find(body);
  return object == objects_.end() ? start_up_->link_names.count(body) == 0 : !object->second.is_unchanged;
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
bool ChangingScene::isNoGrasp(const AllowedPair& pair) const {
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
/// @return their names, if there are rules.
std::set<NamePair> ChangingScene::keepAllowed(RuleIndex& rules, std::vector<AllowedPair>& allowed) const {
  std::set<NamePair> kept;
  for (const AllowedPair& pair : start_up_->allowed) {
    if (hasChanged(pair.body_a) || hasChanged(pair.body_b)) continue;
    const RequestRule* rule = rules.last(pair.body_a, pair.body_b);
    if (rule && !rule->is_allowed && !pair.proved) continue;
    allowed.push_back(pair);
    if (rule && pair.proved) {
      const auto proof = start_up_->proofs.find(namePair(pair.body_a, pair.body_b));
      std::string& reason = allowed.back().reason;
      if (rule->is_allowed) {
        reason = textOf(*rule);
      } else if (proof != start_up_->proofs.end()) {
        reason = proof->second;
      }
    }
    if (!rules_.empty()) kept.insert(namePair(pair.body_a, pair.body_b));
  }
  return kept;
}

SceneDescription ChangingScene::description(const RequestLimits& limits) const {
  if (objects_.size() > limits.objects)
    throw std::length_error("more than " + std::to_string(limits.objects) + " objects");
  SceneDescription scene;
  scene.visual_only = start_up_->visual_only;
  scene.has_live_map = !start_up_->tiles_begin.empty();
  scene.bodies = start_up_->links;
  std::vector<const Object*> ordered;
  for (const auto& [name, object] : objects_) ordered.push_back(&object);
  std::sort(ordered.begin(), ordered.end(), [](const Object* a, const Object* b) { return a->order < b->order; });
  for (const Object* object : ordered) scene.bodies.push_back(object->body);
  const std::size_t first_tile = scene.bodies.size();
  if (tiles_)
    std::copy_if(tiles_->begin(), tiles_->end(), std::back_inserter(scene.bodies),
                 [&](const BodyDescription& tile) { return !isJudgedAsObject(tile); });

  const auto objectOf = [&](std::size_t body) -> const Object* {
    return body < start_up_->links.size() || body >= first_tile ? nullptr : ordered[body - start_up_->links.size()];
  };
  RuleIndex rules = ruleIndex();
  const std::set<NamePair> left_out = keepAllowed(rules, scene.allowed);
  const auto moving = static_cast<std::size_t>(std::count_if(
      scene.bodies.begin(), scene.bodies.end(), [](const BodyDescription& body) { return !body.is_world; }));
  if (moving * first_tile > limits.pairs)  // tiles do not count: no request may keep a map out
    throw std::length_error("more than " + std::to_string(limits.pairs) + " pairs");

  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    checkCancelled();
    const Object* a = objectOf(i);
    for (std::size_t k = i + 1; k < scene.bodies.size(); ++k) {
      const Object* b = objectOf(k);
      const BodyDescription &body_a = scene.bodies[i], &body_b = scene.bodies[k];
      if (body_a.is_world && body_b.is_world) continue;
      const bool is_new = (a && !a->is_unchanged) || (b && !b->is_unchanged);
      if (!is_new && rules_.empty() && (k < first_tile || start_up_->rules.allowed.empty())) continue;
      const RequestRule* rule = rules.last(body_a.name, body_b.name);
      bool proved = false;
      std::string reason;
      if (is_new) reason = b && !b->is_unchanged ? whyLeftOut(*b, body_a, proved) : whyLeftOut(*a, body_b, proved);
      if (reason.empty() && !proved && k >= first_tile) reason = whyAllowed(start_up_->rules, body_b.name, body_a.name);
      if (rule) reason = rule->is_allowed ? textOf(*rule) : proved ? kRigidlyJoined : "";
      if (reason.empty() || left_out.count(namePair(body_a.name, body_b.name)) > 0) continue;
      scene.allowed.push_back({body_a.name, body_b.name, reason, proved});
    }
  }
  addProofs(*start_up_->robot, scene.bodies, scene.allowed, start_up_->tf_prefix);
  return scene;
}

std::size_t ChangingScene::allowedByRequests(const SceneDescription& description) const {
  RuleIndex rules = ruleIndex();
  return static_cast<std::size_t>(std::count_if(
      description.allowed.begin(), description.allowed.end(),
      [&](const AllowedPair& pair) { return pair.reason == kTouchLinks || rules.allowing(pair.body_a, pair.body_b); }));
}

std::string ChangingScene::weakened(const SceneDescription& description) const {
  RuleIndex rules = ruleIndex();
  std::size_t pairs = 0;
  std::string first;
  const auto uses_patterns = [&](const std::string& body) {
    const auto object = objects_.find(body);
    return object != objects_.end() &&
           std::any_of(object->second.touch_links.begin(), object->second.touch_links.end(), isPattern);
  };
  for (const AllowedPair& pair : description.allowed) {
    const bool by_touch_links =
        pair.reason == kTouchLinks && (uses_patterns(pair.body_a) || uses_patterns(pair.body_b) || isNoGrasp(pair));
    if (!by_touch_links && !rules.allowing(pair.body_a, pair.body_b)) continue;
    if (pairs++ == 0) first = pairName(pair.body_a, pair.body_b);
  }
  std::string text;
  if (pairs > 0) text = "requests allow " + counted(pairs, "pair") + " to touch, for example " + first;
  std::vector<std::string> changed;
  for (const std::string& name : start_up_->objects)
    if (hasChanged(name)) changed.push_back(name);
  if (!changed.empty()) {
    text += (text.empty() ? "requests have" : ", and have") + std::string(" removed, moved, replaced or attached ") +
            counted(changed.size(), "object") + " of the parameters, for example " + changed.front();
  }
  return text;
}

std::vector<UnreachablePair> ChangingScene::unreachable(const SceneDescription& description) const {
  std::map<std::string, int> indices;
  for (std::size_t b = 0; b < description.bodies.size(); ++b) indices[description.bodies[b].name] = static_cast<int>(b);
  const auto indexOf = [&](const std::string& name) {
    const auto found = indices.find(name);
    return hasChanged(name) || found == indices.end() ? -1 : found->second;
  };
  std::vector<UnreachablePair> pairs;
  for (std::size_t p = 0; p < start_up_->unreachable.size(); ++p) {
    UnreachablePair pair = start_up_->unreachable[p];
    pair.body_a = indexOf(start_up_->unreachable_names[p].first);
    pair.body_b = indexOf(start_up_->unreachable_names[p].second);
    if (pair.body_a >= 0 && pair.body_b >= 0) pairs.push_back(std::move(pair));
  }
  std::vector<AllowedPair> joined;  // since then
  for (const AllowedPair& pair : description.allowed)
    if (pair.reason == kRigidlyJoined && (hasChanged(pair.body_a) || hasChanged(pair.body_b))) joined.push_back(pair);
  const std::vector<UnreachablePair> later = unreachablePairs(description.bodies, joined);
  pairs.insert(pairs.end(), later.begin(), later.end());
  return pairs;
}

}  // namespace sdf_ccd
