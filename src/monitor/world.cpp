#include "sdf_ccd/scene.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <set>
#include <unordered_map>

#include "common/cancel_point.h"
#include "common/seconds_since.h"
#include "prepared_bodies.h"
#include "resting_answers.h"
#include "scene/build_body.h"
#include "scene/plan/scene_totals.h"
#include "scene/plan/surface_needs.h"
#include "untestable_pairs.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

std::shared_ptr<const Body> placed(const Body& prepared, const BodyDescription& description) {
  auto body = std::make_shared<Body>(prepared);
  static_cast<BodyPlace&>(*body) = description;
  return body;
}

/// The description of a built scene, with the failures and the pairs that were left out during building.
SceneDescription withLeftOut(SceneDescription description, const ScenePlan& plan, const Scene& scene) {
  for (std::size_t b = 0; b < description.bodies.size(); ++b) description.bodies[b].failure = scene.bodies[b].failure;
  std::set<std::pair<int, int>> planned;
  for (const PlannedPair& pair : plan.pairs) planned.emplace(pair.body_a, pair.body_b);
  for (const PairDecision& pair : scene.left_out)
    if (planned.count({pair.a, pair.b}) > 0) description.allowed.push_back(pair);
  return description;
}

/// The body of each description; null for those that cannot be checked, or are in no pair.
/// @param get  returns the body of a description, with what plan.needs says. Called again when more is needed.
template <class Get>
std::vector<PreparedBody*> bodiesFor(const SceneDescription& description, ScenePlan& plan, const Get& get) {
  const std::size_t count = description.bodies.size();
  std::vector<PreparedBody*> prepared(count, nullptr);
  const auto prepare = [&](std::size_t b) {
    checkCancelled();
    if (description.bodies[b].failure.empty() && plan.needs[b].any()) prepared[b] = get(b);
  };
  for (std::size_t b = 0; b < count; ++b) prepare(b);
  for (std::size_t b = 0; b < count; ++b) prepare(b);  // a body of equal geometry may have replaced one since
  for (std::size_t b = 0; b < count; ++b) {
    if (!needsSurface(description, description.bodies[b]) || !prepared[b]) continue;
    plan.needs[b].surface = true;
    prepare(b);
  }
  return prepared;
}

}  // namespace

struct WorldEditor::Parts {
  PreparedBodies bodies;  // all that the version needs
  int made = 0;           // of them
  std::vector<std::string> warnings;
};

struct WorldEditor::Impl {
  /// A body of the last version.
  struct Named {
    std::uint64_t id;
    std::shared_ptr<const Body> body, prepared;
  };

  using Shared = std::shared_ptr<const Body>;

  std::vector<std::string> keysOf(const SceneDescription& description);
  std::optional<PreparedBody> kept(const std::string& key);
  std::vector<Shared> addBodies(const SceneDescription& description, const std::vector<PreparedBody*>& prepared,
                                WorldSnapshot& snapshot, Scene& scene);
  std::shared_ptr<const WorldSnapshot> finish(SceneDescription description, const std::vector<Shared>& prepared,
                                              Scene scene, std::shared_ptr<WorldSnapshot> snapshot);

  BodyOptions options;
  GeometryKeys keys;
  std::mutex mutex;       // of what follows
  PreparedBodies bodies;  // of the last version, and some that are no longer used
  std::unordered_map<std::string, Named> named;
  std::uint64_t last_id = 0, last_version = 0;
  std::shared_ptr<RestingAnswers> resting = std::make_shared<RestingAnswers>();  // of all versions
};

WorldEditor::WorldEditor(const BodyOptions& options) : impl_(new Impl) {
  impl_->options = options;
}
WorldEditor::~WorldEditor() = default;

std::vector<std::string> WorldEditor::Impl::keysOf(const SceneDescription& description) {
  std::vector<std::string> of_bodies;
  for (const BodyDescription& body : description.bodies) of_bodies.push_back(keys.keyOf(body));
  return of_bodies;
}

std::optional<PreparedBody> WorldEditor::Impl::kept(const std::string& key) {
  const std::lock_guard<std::mutex> lock(mutex);
  const PreparedBody* const body = bodies.find(key);
  return body ? std::optional<PreparedBody>(*body) : std::nullopt;
}

/// Adds the bodies, those of the last version where nothing has changed, and their reports. @return as prepared
std::vector<WorldEditor::Impl::Shared> WorldEditor::Impl::addBodies(const SceneDescription& description,
                                                                    const std::vector<PreparedBody*>& prepared,
                                                                    WorldSnapshot& snapshot, Scene& scene) {
  std::vector<Shared> found(prepared.size());
  std::set<const PreparedBody*> counted;
  for (std::size_t b = 0; b < prepared.size(); ++b) {
    const BodyDescription& body = description.bodies[b];
    if (prepared[b]) prepared[b]->used = snapshot.version;
    if (prepared[b]) found[b] = prepared[b]->body;
    const auto known = named.find(body.name);
    const bool same = known != named.end() && known->second.prepared == found[b] &&
                      static_cast<const BodyPlace&>(*known->second.body) == body;
    scene.bodies.push_back(same ? known->second.body : placed(found[b] ? *found[b] : Body(), body));
    if (!same && found[b]) ++snapshot.shared;
    scene.reports.push_back(prepared[b] ? prepared[b]->report : BodyReport());
    scene.reports.back().name = body.name;
    if (prepared[b] && !counted.insert(prepared[b]).second) countAsShared(scene.reports.back());
  }
  snapshot.shared = std::max(0, snapshot.shared - snapshot.prepared);
  return found;
}

/// Makes it the last version: assigns body ids, and stores its bodies by name.
std::shared_ptr<const WorldSnapshot> WorldEditor::Impl::finish(SceneDescription description,
                                                               const std::vector<Shared>& prepared, Scene scene,
                                                               std::shared_ptr<WorldSnapshot> snapshot) {
  snapshot->seconds = scene.build_seconds;
  resting = scene.resting;
  snapshot->description = std::make_shared<const SceneDescription>(std::move(description));
  snapshot->scene = std::make_shared<const Scene>(std::move(scene));
  std::unordered_map<std::string, Named> now;
  const BodyList& list = snapshot->scene->bodies;
  for (std::size_t b = 0; b < list.size(); ++b) {
    const auto known = named.find(list[b].name);
    const std::uint64_t id = known == named.end() ? ++last_id : known->second.id;
    snapshot->body_ids.push_back(id);
    now[list[b].name] = {id, list.shared(b), prepared[b]};
  }
  named = std::move(now);
  last_version = snapshot->version;
  return snapshot;
}

std::shared_ptr<const WorldSnapshot> WorldEditor::begin(SceneDescription description, const ScenePlan& plan,
                                                        Scene scene) {
  auto snapshot = std::make_shared<WorldSnapshot>();
  snapshot->version = 1;
  std::vector<std::shared_ptr<const Body>> prepared(description.bodies.size());
  for (std::size_t b = 0; b < prepared.size(); ++b) {
    const Body& body = scene.bodies[b];
    BodyNeeds has = plan.needs[b];
    if (!body.failure.empty() || description.bodies[b].geometry.empty() || !has.any()) continue;
    has.surface = body.surface != nullptr;
    const std::string key = impl_->keys.keyOf(description.bodies[b]);
    PreparedBody* known = impl_->bodies.find(key, has);
    if (!known) known = &impl_->bodies.add(key, has, body, scene.reports[b]);
    known->used = 1;
    prepared[b] = known->body;
    ++snapshot->prepared;
  }
  description = withLeftOut(std::move(description), plan, scene);
  return impl_->finish(std::move(description), prepared, std::move(scene), std::move(snapshot));
}

std::shared_ptr<const WorldEditor::Parts> WorldEditor::prepare(
    const SceneDescription& description, const std::function<void(const std::string&)>& progress) const {
  ScenePlan plan = planScene(description, planOptions(impl_->options));
  const std::vector<std::string> keys = impl_->keysOf(description);
  auto parts = std::make_shared<Parts>();
  MeshPool pool(impl_->options);
  bodiesFor(description, plan, [&](std::size_t b) {
    const std::string& key = keys[b];
    if (PreparedBody* const known = parts->bodies.find(key, plan.needs[b])) return known;
    if (const std::optional<PreparedBody> kept = impl_->kept(key)) {
      parts->bodies.add(key, *kept);
      if (PreparedBody* const known = parts->bodies.find(key, plan.needs[b])) return known;
    }
    const BodyDescription& body = description.bodies[b];
    if (progress) progress(body.name);
    PreparedBody& made = parts->bodies.make(key, body, plan.needs[b], impl_->options, pool);
    ++parts->made;
    for (const std::string& warning : made.report.warnings) parts->warnings.push_back(body.name + ": " + warning);
    return &made;
  });
  return parts;
}

std::shared_ptr<const WorldSnapshot> WorldEditor::next(SceneDescription description, const Parts& parts) {
  const auto start = Clock::now();
  auto snapshot = std::make_shared<WorldSnapshot>();
  ScenePlan plan = planScene(description, planOptions(impl_->options));
  const std::vector<std::string> keys = impl_->keysOf(description);
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  snapshot->version = impl_->last_version + 1;
  snapshot->prepared = parts.made;
  snapshot->warnings = parts.warnings;
  impl_->bodies.merge(parts.bodies);
  bool are_ready = true;
  const std::vector<PreparedBody*> prepared = bodiesFor(description, plan, [&](std::size_t b) {
    PreparedBody* const known = impl_->bodies.find(keys[b], plan.needs[b]);
    are_ready &= known != nullptr;
    return known;
  });
  if (!are_ready) return nullptr;
  Scene scene = plannedScene(description, plan, impl_->options);
  scene.resting = impl_->resting;
  const std::vector<std::shared_ptr<const Body>> bodies = impl_->addBodies(description, prepared, *snapshot, scene);
  if (const std::string warning = warnOfUntestable(scene); !warning.empty()) snapshot->warnings.push_back(warning);
  setParts(plan, scene);
  setTotals(scene);
  scene.build_seconds = secondsSince(start);
  impl_->bodies.dropUnused(snapshot->version);
  return impl_->finish(std::move(description), bodies, std::move(scene), std::move(snapshot));
}

std::shared_ptr<const WorldSnapshot> WorldEditor::next(const SceneDescription& description) {
  for (;;)
    if (auto made = next(description, *prepare(description))) return made;
}

}  // namespace sdf_ccd
