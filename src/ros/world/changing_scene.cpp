#include "ros/world/changing_scene.h"

#include <algorithm>
#include <stdexcept>

#include "common/shown_text.h"
#include "ros/parameters/moveit_scene.h"
#include "ros/parameters/world_file.h"
#include "ros/world/world_bodies.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument(what);
}

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

}  // namespace

struct ChangingScene::Fixed {
  std::shared_ptr<const RobotModel> robot;
  std::string tf_prefix, fixed_frame, tiles_begin;
  PairRules rules;
  std::vector<BodyDescription> links;
  std::set<std::string> link_names;  // of the robot, bodies or not
  std::vector<std::string> visual_only;
  std::vector<AllowedPair> allowed;
  std::vector<UnreachablePair> unreachable;
  std::vector<NamePair> unreachable_names;
  std::set<std::string> root_frames;  // rigidly joined to the root link
};

ChangingScene::ChangingScene(const DescribedScene& described, const PairRules& rules, const SceneDescription& first) {
  auto fixed = std::make_shared<Fixed>();
  fixed->robot = described.robot;
  fixed->tf_prefix = described.tf_prefix;
  fixed->fixed_frame = described.fixed_frame;
  fixed->tiles_begin = described.tiles_begin;
  fixed->rules = rules;
  fixed->visual_only = first.visual_only;
  fixed->allowed = first.allowed;
  fixed->unreachable = described.unreachable;
  for (const UnreachablePair& pair : described.unreachable)
    fixed->unreachable_names.emplace_back(first.bodies[pair.body_a].name, first.bodies[pair.body_b].name);
  for (const std::string& link : described.robot->links()) {
    fixed->link_names.insert(link);
    if (described.robot->rigidlyJoined(described.robot->root(), link))
      fixed->root_frames.insert(described.tf_prefix + link);
  }
  for (const BodyDescription& body : first.bodies) {
    if (!body.is_world) {
      fixed->links.push_back(body);
    } else if (!body.map.empty()) {
      setTiles({body});  // the awaited map
    } else {
      objects_[body.name] = {body, "", {}, ++count_, true};
    }
  }
  fixed_ = fixed;
}

void ChangingScene::apply(const SceneChange& change, ChangeSources& sources) {
  checkCancelled();
  if (change.type <= SceneChange::DETACH) requireName(change.object, "the object's name", sources.limits);
  switch (change.type) {
    case SceneChange::ADD:
      return add(change, sources);
    case SceneChange::MOVE:
      return move(change);
    case SceneChange::REMOVE:
      return erase(change);
    case SceneChange::ATTACH:
      return attach(change, sources);
    case SceneChange::DETACH:
      return detach(change, sources);
    case SceneChange::ALLOW:
    case SceneChange::CHECK:
      return addRule(change, sources.limits);
    case SceneChange::FORGET_RULES:
      return rules_.clear();
    case SceneChange::LOAD:
      return load(change, sources);
    case SceneChange::CLEAR:
      return objects_.clear();
    default:
      refuse("a change of type " + std::to_string(change.type) + " is not known");
  }
}

void ChangingScene::set(BodyDescription body) {
  const auto known = objects_.find(body.name);
  const std::size_t since = known == objects_.end() ? ++count_ : known->second.since;
  const std::string name = body.name;
  objects_[name] = {std::move(body), "", {}, since, false};
}

ChangingScene::Object& ChangingScene::find(const std::string& name) {
  const auto found = objects_.find(name);
  if (found == objects_.end()) refuse("there is no object " + shownText(name));
  return found->second;
}

/// The tf frame in the header of a change; `otherwise` if it is empty.
std::string ChangingScene::frameOf(const SceneChange& change, const std::string& otherwise) const {
  const std::string frame = withoutLeadingSlash(change.header.frame_id);
  if (frame.size() > RequestLimits().name || frame != shownText(frame))
    refuse("frame " + shownText(frame) + " is none");
  return frame.empty() ? otherwise : frame;
}

BodyDescription ChangingScene::make(const SceneChange& change, ChangeSources& sources) const {
  const std::string frame = frameOf(change, fixed_->fixed_frame);
  const Isometry3d X_frame_B = poseIn(change.pose).value_or(Isometry3d::Identity());
  BodyDescription body;
  WorldObject object{change.object, frame, X_frame_B, shapesIn(change, sources.limits, sources.triangles)};
  if (!change.octomap_file.empty()) {
    if (!object.shapes.empty()) refuse("a map stands alone: add other shapes as another object");
    OctomapObject octomap;
    octomap.file = sources.files.path(change.octomap_file);
    octomap.X_frame_B = X_frame_B;
    body = toBody(change.object, octomap, frame);
  } else {
    if (object.shapes.empty()) refuse("object " + change.object + " has no shape");
    const ResourceLoader loader = [&](const std::string& uri) { return sources.files.resource(uri); };
    body = toBody(object, frame, loader, sources.warnings);
  }
  if (!body.failure.empty()) refuse(body.failure);
  return body;
}

/// Throws unless an object may have this name.
void ChangingScene::requireFree(const std::string& name) const {
  if (const std::string why = whyNoName(name); !why.empty()) refuse(why);
  if (fixed_->link_names.count(name) > 0) refuse(name + " is a link of the robot");
  requireNoTile(name, fixed_->tiles_begin);
}

void ChangingScene::add(const SceneChange& change, ChangeSources& sources) {
  requireFree(change.object);
  set(make(change, sources));
}

void ChangingScene::move(const SceneChange& change) {
  Object& object = find(change.object);
  if (!object.link.empty()) refuse(change.object + " is attached to " + object.link + ": attach it anew, or detach it");
  object.body.frame = frameOf(change, object.body.frame);
  object.body.X_frame_B = poseIn(change.pose).value_or(Isometry3d::Identity());
  object.is_as_first = false;
}

void ChangingScene::erase(const SceneChange& change) {
  if (!isPattern(change.object)) {
    find(change.object);
    objects_.erase(change.object);
    return;
  }
  for (auto object = objects_.begin(); object != objects_.end();)
    object = matches(change.object, object->first) ? objects_.erase(object) : std::next(object);
}

void ChangingScene::attach(const SceneChange& change, ChangeSources& sources) {
  if (fixed_->link_names.count(change.link) == 0) refuse("the robot has no link " + shownText(change.link));
  const std::string link_frame = fixed_->tf_prefix + change.link;
  SceneChange made = change;
  if (made.header.frame_id.empty()) made.header.frame_id = link_frame;
  if (objects_.count(change.object) == 0) add(made, sources);
  Object& object = find(change.object);
  const auto given = poseIn(change.pose);
  const std::string frame = given ? frameOf(made, link_frame) : object.body.frame;
  const Isometry3d X_FB = given ? *given : object.body.X_frame_B;
  Isometry3d X_LB = X_FB;
  if (frame != link_frame) X_LB = poseOf(sources.history, frame, link_frame, change.header.stamp) * X_FB;
  if (change.touch_links.size() > sources.limits.rules) refuse("too many touch_links");
  for (const std::string& touched : change.touch_links) requireName(touched, "a touch_link", sources.limits);
  object.body.frame = link_frame;
  object.body.X_frame_B = X_LB;
  object.body.is_world = false;
  object.link = change.link;
  object.touch_links = change.touch_links;
  object.is_as_first = false;
}

void ChangingScene::detach(const SceneChange& change, ChangeSources& sources) {
  Object& object = find(change.object);
  if (object.link.empty()) refuse(change.object + " is not attached");
  const std::string frame = frameOf(change, fixed_->fixed_frame);
  if (const auto given = poseIn(change.pose)) {
    object.body.X_frame_B = *given;
  } else {
    object.body.X_frame_B =
        poseOf(sources.history, object.body.frame, frame, change.header.stamp) * object.body.X_frame_B;
  }
  object.body.frame = frame;
  object.body.is_world = true;
  object.link.clear();
  object.touch_links.clear();
}

void ChangingScene::addRule(const SceneChange& change, const RequestLimits& limits) {
  requireName(change.body_a, "body_a", limits);
  requireName(change.body_b, "body_b", limits);
  const auto same = [&](const Rule& rule) {
    return namePair(rule.pair.a, rule.pair.b) == namePair(change.body_a, change.body_b);
  };
  rules_.erase(std::remove_if(rules_.begin(), rules_.end(), same), rules_.end());
  if (rules_.size() >= limits.rules)
    refuse("more than " + std::to_string(limits.rules) + " rules about pairs: FORGET_RULES begins anew");
  rules_.push_back({{change.body_a, change.body_b}, change.type == SceneChange::ALLOW});
}

void ChangingScene::load(const SceneChange& change, ChangeSources& sources) {
  const ResourceLoader loader = [&](const std::string& uri) { return sources.files.resource(uri); };
  for (const WorldObject& object : loadWorldFile(sources.files.path(change.file))) {
    checkCancelled();
    requireName(object.name, "an object's name", sources.limits);
    requireFree(object.name);
    const std::string frame = object.frame.empty() ? fixed_->fixed_frame : withoutLeadingSlash(object.frame);
    BodyDescription body = toBody(object, frame, loader, sources.warnings);
    if (!body.failure.empty()) refuse(body.failure);
    set(std::move(body));
  }
}

const ChangingScene::Rule* ChangingScene::lastRule(const std::string& a, const std::string& b) const {
  const auto found =
      std::find_if(rules_.rbegin(), rules_.rend(), [&](const Rule& rule) { return matches(rule.pair, a, b); });
  return found == rules_.rend() ? nullptr : &*found;
}

/// Why the pair of an object that has changed since start-up and another body, not both of the world, is left out;
/// empty if it is checked.
/// @param proved  receives whether they cannot touch, so that no rule can add the pair.
std::string ChangingScene::whyLeftOut(const Object& object, const BodyDescription& other, bool& proved) const {
  const std::string& name = object.body.name;
  const auto known = objects_.find(other.name);
  const std::string& other_link = known == objects_.end() ? other.name : known->second.link;
  proved = true;
  const auto isLink = [&](const std::string& link) { return fixed_->link_names.count(link) > 0; };
  if (isLink(object.link) && isLink(other_link) && fixed_->robot->rigidlyJoined(object.link, other_link))
    return "rigidly joined";
  const bool rests = fixed_->root_frames.count(object.body.frame) > 0 || object.body.frame == other.frame;
  if (object.link.empty() && rests && fixed_->root_frames.count(other.frame) > 0) return "rigidly joined";
  proved = false;
  const auto mayTouch = [](const std::vector<std::string>& patterns, const std::string& touched) {
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const auto& pattern) { return matches(pattern, touched); });
  };
  const bool are_of_robot = isLink(object.link) && isLink(other_link);
  const bool may_touch = mayTouch(object.touch_links, other.name) ||
                         (known != objects_.end() && mayTouch(known->second.touch_links, name));
  if (are_of_robot && may_touch) return "attached, and may touch";
  return whyAllowed(fixed_->rules, name, other.name);
}

SceneDescription ChangingScene::description(const RequestLimits& limits) const {
  if (objects_.size() > limits.objects)
    throw std::length_error("more than " + std::to_string(limits.objects) + " objects");
  SceneDescription scene;
  scene.visual_only = fixed_->visual_only;
  scene.bodies = fixed_->links;
  std::vector<const Object*> ordered;
  for (const auto& [name, object] : objects_) ordered.push_back(&object);
  std::sort(ordered.begin(), ordered.end(), [](const Object* a, const Object* b) { return a->since < b->since; });
  for (const Object* object : ordered) scene.bodies.push_back(object->body);
  const std::size_t first_tile = scene.bodies.size();
  if (tiles_) scene.bodies.insert(scene.bodies.end(), tiles_->begin(), tiles_->end());

  const auto objectOf = [&](std::size_t body) -> const Object* {
    return body < fixed_->links.size() || body >= first_tile ? nullptr : ordered[body - fixed_->links.size()];
  };
  // Pairs that were left out at start-up, of bodies that have not changed since.
  std::set<std::string> as_first;
  for (const BodyDescription& link : fixed_->links) as_first.insert(link.name);
  for (const Object* object : ordered)
    if (object->is_as_first) as_first.insert(object->body.name);
  std::set<NamePair> left_out;
  for (const AllowedPair& pair : fixed_->allowed) {
    if (as_first.count(pair.body_a) == 0 || as_first.count(pair.body_b) == 0) {
      const bool are_links = fixed_->link_names.count(pair.body_a) > 0 && fixed_->link_names.count(pair.body_b) > 0;
      if (!are_links) continue;
    }
    const Rule* rule = pair.proved ? nullptr : lastRule(pair.body_a, pair.body_b);
    if (rule && !rule->is_allowed) continue;
    scene.allowed.push_back(pair);
    if (!rules_.empty()) left_out.insert(namePair(pair.body_a, pair.body_b));
  }
  const auto moving = static_cast<std::size_t>(std::count_if(
      scene.bodies.begin(), scene.bodies.end(), [](const BodyDescription& body) { return !body.is_world; }));
  if (moving * scene.bodies.size() > limits.pairs)
    throw std::length_error("more than " + std::to_string(limits.pairs) + " pairs");

  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    checkCancelled();
    const Object* a = objectOf(i);
    for (std::size_t k = i + 1; k < scene.bodies.size(); ++k) {
      const Object* b = objectOf(k);
      const BodyDescription &body_a = scene.bodies[i], &body_b = scene.bodies[k];
      if (body_a.is_world && body_b.is_world) continue;
      const bool is_new = (a && !a->is_as_first) || (b && !b->is_as_first);
      if (!is_new && rules_.empty() && (k < first_tile || fixed_->rules.allowed.empty())) continue;
      const Rule* rule = lastRule(body_a.name, body_b.name);
      bool proved = false;
      std::string reason;
      if (is_new) reason = b && !b->is_as_first ? whyLeftOut(*b, body_a, proved) : whyLeftOut(*a, body_b, proved);
      if (reason.empty() && !proved && k >= first_tile) reason = whyAllowed(fixed_->rules, body_b.name, body_a.name);
      if (rule && !proved) reason = rule->is_allowed ? "update_scene: " + rule->pair.a + " - " + rule->pair.b : "";
      if (reason.empty() || left_out.count(namePair(body_a.name, body_b.name)) > 0) continue;
      scene.allowed.push_back({body_a.name, body_b.name, reason, proved});
    }
  }
  return scene;
}

std::vector<UnreachablePair> ChangingScene::unreachable(const SceneDescription& description) const {
  std::map<std::string, int> places;
  for (std::size_t b = 0; b < description.bodies.size(); ++b) places[description.bodies[b].name] = static_cast<int>(b);
  std::vector<UnreachablePair> pairs;
  for (std::size_t p = 0; p < fixed_->unreachable.size(); ++p) {
    UnreachablePair pair = fixed_->unreachable[p];
    const auto placeOf = [&](const std::string& name) {
      const auto object = objects_.find(name);
      const bool has_changed =
          object == objects_.end() ? fixed_->link_names.count(name) == 0 : !object->second.is_as_first;
      const auto place = places.find(name);
      return has_changed || place == places.end() ? -1 : place->second;
    };
    pair.body_a = placeOf(fixed_->unreachable_names[p].first);
    pair.body_b = placeOf(fixed_->unreachable_names[p].second);
    if (pair.body_a >= 0 && pair.body_b >= 0) pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<std::string> ChangingScene::objects() const {
  std::vector<std::string> names;
  for (const auto& [name, object] : objects_) names.push_back(name);
  return names;
}

std::string ChangingScene::text(const ChangeSources& sources, std::vector<std::string>& warnings) const {
  std::vector<BodyDescription> bodies;
  for (const auto& [name, object] : objects_) {
    BodyDescription body = object.body;
    if (std::any_of(body.geometry.begin(), body.geometry.end(),
                    [](const auto& part) { return part.watertight_voxels; })) {
      warnings.push_back(name + " is a map, and is not written");
      continue;
    }
    if (!body.failure.empty()) {
      warnings.push_back(name + " is not saved, as it cannot be checked: " + body.failure);
      continue;
    }
    if (body.frame != fixed_->fixed_frame)
      body.X_frame_B = lookup(sources.history, body.frame, ros::Time()) * body.X_frame_B;
    bodies.push_back(std::move(body));
  }
  return moveitScene(bodies);
}

}  // namespace sdf_ccd
