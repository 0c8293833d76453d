#include "sdf_ccd/monitor/world.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <unordered_map>

#include "body/body_place.h"
#include "body/body_triangles.h"
#include "common/seconds_since.h"
#include "model/name_pair.h"
#include "monitor/scene_cost.h"
#include "prepared_bodies.h"
#include "scene_totals.h"
#include "sdf_ccd/common/cancel.h"
#include "surface_crossing.h"
#include "surface_needs.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongTime = 1.0;  // of making a version [s]

std::shared_ptr<const Body> placed(const Body& prepared, const BodyDescription& description) {
  auto body = std::make_shared<Body>(prepared);
  setPlace(description, *body);
  return body;
}

/// The description of a built scene, with the failures and the pairs that were left out during building.
SceneDescription withLeftOut(SceneDescription description, const ScenePlan& plan, const Scene& scene) {
  for (std::size_t b = 0; b < description.bodies.size(); ++b) description.bodies[b].failure = scene.bodies[b].failure;
  std::set<std::pair<int, int>> kept;
  for (const PlannedPair& pair : scene.pairs) kept.emplace(pair.body_a, pair.body_b);
  std::map<std::pair<int, int>, const std::string*> reasons;
  for (const LeftOut& left_out : scene.left_out)
    reasons.emplace(std::pair(left_out.body_a, left_out.body_b), &left_out.reason);
  for (const PlannedPair& pair : plan.pairs) {
    if (kept.count({pair.body_a, pair.body_b}) > 0) continue;
    const std::string &a = description.bodies[pair.body_a].name, &b = description.bodies[pair.body_b].name;
    const auto reason = reasons.find({pair.body_a, pair.body_b});
    description.allowed.push_back({a, b, reason == reasons.end() ? "left out" : *reason->second});
  }
  return description;
}

}  // namespace

struct WorldEditor::Impl {
  /// A body of the last version.
  struct Named {
    std::uint64_t id;
    std::shared_ptr<const Body> body, prepared;
  };

  std::vector<PreparedNeeds> needsOf(const SceneDescription& description, const ScenePlan& plan) const;
  SceneCost affordableCost(const SceneDescription& description, const ScenePlan& plan,
                           const std::vector<std::string>& keys, const std::vector<PreparedNeeds>& needs);
  void finish(WorldSnapshot& snapshot, const std::vector<std::shared_ptr<const Body>>& prepared);

  const DistanceField* fieldOf(const GeometryDescription& part) const;
  void provideFields(const BodyDescription& body, MeshPool& pool) const;
  void forgetFields();

  /// The field of a mesh, made elsewhere.
  struct Provided {
    std::weak_ptr<const TriangleMesh> mesh;
    DistanceField field;
  };

  BodyOptions options;
  std::unordered_map<const TriangleMesh*, Provided> fields;
  GeometryKeys keys;
  PreparedBodies bodies;
  std::unordered_map<std::string, Named> named;
  std::uint64_t last_id = 0;
  std::shared_ptr<const WorldSnapshot> last;
};

WorldEditor::WorldEditor(const BodyOptions& options) : impl_(new Impl) {
  impl_->options = options;
}
WorldEditor::~WorldEditor() = default;

const std::shared_ptr<const WorldSnapshot>& WorldEditor::last() const {
  return impl_->last;
}

void WorldEditor::provide(const std::shared_ptr<const TriangleMesh>& mesh, const DistanceField& field) {
  impl_->fields.insert_or_assign(mesh.get(), Impl::Provided{mesh, field});
}

const DistanceField* WorldEditor::Impl::fieldOf(const GeometryDescription& part) const {
  const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&part.shape);
  const auto found = mesh ? fields.find(mesh->get()) : fields.end();
  return found != fields.end() && found->second.mesh.lock() == *mesh ? &found->second.field : nullptr;
}

void WorldEditor::Impl::provideFields(const BodyDescription& body, MeshPool& pool) const {
  for (const GeometryDescription& part : body.geometry)
    if (const DistanceField* field = fieldOf(part)) pool.find(part).field = *field;
}

/// Removes fields whose meshes no longer exist.
void WorldEditor::Impl::forgetFields() {
  for (auto field = fields.begin(); field != fields.end();)
    field = field->second.mesh.expired() ? fields.erase(field) : std::next(field);
}

/// The needs of all bodies except BodySurface, which depends on the fields once these are built.
std::vector<PreparedNeeds> WorldEditor::Impl::needsOf(const SceneDescription& description,
                                                      const ScenePlan& plan) const {
  std::vector<PreparedNeeds> needs(description.bodies.size());
  const std::vector<char> decides = shellsThatDecide(description, plan);
  std::vector<char> can_be_triangles;
  for (std::size_t b = 0; b < needs.size(); ++b) {
    needs[b].of_body = {plan.needs_field[b], plan.needs_shell[b], plan.edges_only[b], decides[b] != 0,
                        plan.needs_witnesses[b]};
    const BodyDescription& body = description.bodies[b];
    can_be_triangles.push_back(body.failure.empty() && mayHaveTriangles(body));
  }
  for (const PlannedPair& pair : plan.pairs) {
    const auto a = static_cast<std::size_t>(pair.body_a), b = static_cast<std::size_t>(pair.body_b);
    if (can_be_triangles[a] != 0 && can_be_triangles[b] != 0) needs[a].triangles = needs[b].triangles = true;
  }
  return needs;
}

/// The cost of the bodies that are not prepared yet. @throws as requireAffordable().
SceneCost WorldEditor::Impl::affordableCost(const SceneDescription& description, const ScenePlan& plan,
                                            const std::vector<std::string>& keys,
                                            const std::vector<PreparedNeeds>& needs) {
  SceneDescription missing;
  ScenePlan missing_plan;
  for (std::size_t b = 0; b < keys.size(); ++b) {
    const BodyDescription& body = description.bodies[b];
    if (!body.failure.empty() || !needs[b].of_body.any() || bodies.find(keys[b], needs[b])) continue;
    const bool has_mesh =
        std::any_of(body.geometry.begin(), body.geometry.end(), [this](const GeometryDescription& part) {
          return !std::holds_alternative<Primitive>(part.shape) && !fieldOf(part);
        });
    const bool is_large_primitive = !has_mesh && plan.needs_shell[b] && !plan.edges_only[b];
    if (!has_mesh && !is_large_primitive) continue;  // their cost is negligible
    missing.bodies.push_back(body);
    missing_plan.needs_field.push_back(plan.needs_field[b]);
    missing_plan.needs_shell.push_back(plan.needs_shell[b]);
    missing_plan.edges_only.push_back(plan.edges_only[b]);
    missing_plan.needs_witnesses.push_back(plan.needs_witnesses[b]);
  }
  if (missing.bodies.empty()) return {};
  SceneCost cost = expectedCost(missing, missing_plan, options);
  requireAffordable(cost, options);
  return cost;
}

/// Assigns body ids and stores the version's bodies by name.
void WorldEditor::Impl::finish(WorldSnapshot& snapshot, const std::vector<std::shared_ptr<const Body>>& prepared) {
  std::unordered_map<std::string, Named> now;
  const BodyList& list = snapshot.scene->bodies;
  for (std::size_t b = 0; b < list.size(); ++b) {
    const auto known = named.find(list[b].name);
    const std::uint64_t id = known == named.end() ? ++last_id : known->second.id;
    snapshot.body_ids.push_back(id);
    now[list[b].name] = {id, list.shared(b), prepared[b]};
  }
  named = std::move(now);
}

std::shared_ptr<const WorldSnapshot> WorldEditor::begin(SceneDescription description, const ScenePlan& plan,
                                                        Scene scene) {
  auto snapshot = std::make_shared<WorldSnapshot>();
  snapshot->version = 1;
  snapshot->seconds = scene.build_seconds;
  const std::vector<PreparedNeeds> needs = impl_->needsOf(description, plan);
  std::vector<std::shared_ptr<const Body>> prepared(description.bodies.size());
  for (std::size_t b = 0; b < prepared.size(); ++b) {
    const Body& body = scene.bodies[b];
    if (!body.failure.empty() || description.bodies[b].geometry.empty() || !needs[b].of_body.any()) continue;
    PreparedNeeds has = needs[b];
    has.surface = body.surface != nullptr;
    const std::string key = impl_->keys.keyOf(description.bodies[b]);
    PreparedBody* known = impl_->bodies.find(key, has);
    if (!known) known = &impl_->bodies.add(key, has, body, scene.reports[b]);
    known->used = 1;
    prepared[b] = known->body;
    ++snapshot->prepared;
  }
  snapshot->description = std::make_shared<const SceneDescription>(withLeftOut(std::move(description), plan, scene));
  snapshot->scene = std::make_shared<const Scene>(std::move(scene));
  impl_->finish(*snapshot, prepared);
  impl_->last = snapshot;
  return snapshot;
}

std::shared_ptr<const WorldSnapshot> WorldEditor::next(SceneDescription description,
                                                       const std::function<void(const std::string&)>& progress,
                                                       const std::function<void(const std::string&)>& announce) {
  const auto start = Clock::now();
  const std::uint64_t version = impl_->last ? impl_->last->version + 1 : 1;
  const ScenePlan plan = planScene(description, planOptions(impl_->options));
  const std::size_t count = description.bodies.size();
  std::vector<PreparedNeeds> needs = impl_->needsOf(description, plan);
  std::vector<std::string> keys;
  for (const BodyDescription& body : description.bodies) keys.push_back(impl_->keys.keyOf(body));
  const SceneCost cost = impl_->affordableCost(description, plan, keys, needs);
  if (announce && cost.seconds > kLongTime) announce(summary(cost));

  auto snapshot = std::make_shared<WorldSnapshot>();
  snapshot->version = version;
  MeshPool pool(impl_->options);
  std::vector<PreparedBody*> prepared(count, nullptr);
  const auto prepare = [&](std::size_t b) {
    checkCancelled();
    const BodyDescription& body = description.bodies[b];
    if (!body.failure.empty() || !needs[b].of_body.any()) return;
    prepared[b] = impl_->bodies.find(keys[b], needs[b]);
    if (prepared[b]) return;
    if (progress) progress(body.name);
    impl_->provideFields(body, pool);
    prepared[b] = &impl_->bodies.make(keys[b], body, needs[b], impl_->options, pool);
    ++snapshot->prepared;
    for (const std::string& warning : prepared[b]->report.warnings)
      snapshot->warnings.push_back(body.name + ": " + warning);
  };
  for (std::size_t b = 0; b < count; ++b) prepare(b);
  for (std::size_t b = 0; b < count; ++b) prepare(b);  // a body of equal geometry may have replaced one since
  const auto isOpen = [&](int b) { return prepared[b] && isInsideUncertain(*prepared[b]->body); };
  const std::vector<bool> surfaces = needSurface(description, plan.pairs, isOpen);
  for (std::size_t b = 0; b < count; ++b) {
    if (!surfaces[b] || !prepared[b] || needs[b].surface) continue;
    needs[b].surface = true;
    prepare(b);
  }

  Scene scene;
  scene.max_error = impl_->options.max_error;
  scene.pairs = plan.pairs;
  scene.left_out = plan.left_out;
  scene.visual_only = description.visual_only;
  std::vector<std::shared_ptr<const Body>> bodies(count);
  std::set<const PreparedBody*> counted;
  for (std::size_t b = 0; b < count; ++b) {
    const BodyDescription& body = description.bodies[b];
    if (prepared[b]) prepared[b]->used = version;
    if (prepared[b]) bodies[b] = prepared[b]->body;
    const auto known = impl_->named.find(body.name);
    const bool same =
        known != impl_->named.end() && known->second.prepared == bodies[b] && hasPlace(*known->second.body, body);
    scene.bodies.push_back(same ? known->second.body : placed(bodies[b] ? *bodies[b] : Body(), body));
    if (!same && bodies[b]) ++snapshot->shared;
    scene.reports.push_back(prepared[b] ? prepared[b]->report : BodyReport());
    scene.reports.back().name = body.name;
    if (prepared[b] && !counted.insert(prepared[b]).second) countAsShared(scene.reports.back());
    if (!prepared[b]) scene.reports.back().field = body.failure.empty() ? "left out" : "failed";
  }
  snapshot->shared = std::max(0, snapshot->shared - snapshot->prepared);
  countPairs(scene);
  scene.motion_margin = impl_->options.motion_margin;
  scene.motion_error = impl_->options.motion_error;
  setBounds(scene);
  scene.build_seconds = secondsSince(start);
  snapshot->seconds = scene.build_seconds;
  snapshot->description = std::make_shared<const SceneDescription>(std::move(description));
  snapshot->scene = std::make_shared<const Scene>(std::move(scene));
  impl_->bodies.dropUnused(version);
  impl_->forgetFields();
  impl_->finish(*snapshot, bodies);
  impl_->last = snapshot;
  return snapshot;
}

}  // namespace sdf_ccd
