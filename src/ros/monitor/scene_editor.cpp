#include "ros/monitor/scene_editor.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <stdexcept>

#include <ros/package.h>

#include "common/cancel_point.h"
#include "common/number_text.h"
#include "common/seconds_since.h"
#include "robot_monitor/awaited_tile.h"
#include "ros/monitor/low_priority.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMaxCallers = 3;  // one that changes the scene, and others that wait
constexpr auto kTurnPeriod = std::chrono::milliseconds(20);

int lastChangeOf(const std::string& id, const UpdateScene::Request& request) {
  for (auto change = request.changes.rbegin(); change != request.changes.rend(); ++change)
    if (change->id == id) return static_cast<int>(request.changes.rend() - change) - 1;
  return -1;
}

}  // namespace

/// The exclusive right to make the next version, for its lifetime.
class SceneEditor::Turn {
 public:
  Turn(SceneEditor& editor, Changer changer) : editor_(editor) {
    const CancelPoint cancel;
    const bool is_map = changer == Changer::kMap;
    std::unique_lock<std::mutex> lock(editor.turn_mutex_);
    editor.maps_waiting_ += is_map;
    while (editor.is_busy_ || (!is_map && editor.maps_waiting_ > 0)) {
      editor.turn_changed_.wait_for(lock, kTurnPeriod);
      if (!cancel.requested()) continue;
      editor.maps_waiting_ -= is_map;
      throw Cancelled();
    }
    editor.maps_waiting_ -= is_map;
    editor.is_busy_ = true;
  }
  ~Turn() {
    {
      const std::lock_guard<std::mutex> lock(editor_.turn_mutex_);
      editor_.is_busy_ = false;
    }
    editor_.turn_changed_.notify_all();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  SceneEditor& editor_;
};

/// A version that is being made.
struct SceneEditor::Draft {
  Changer changer;
  ChangingScene scene;  // with what this changer changes
  WorkArena& arena;
  std::shared_ptr<const WorldEditor::Parts> parts;
  std::string making;                         // the body that is being built: after an exception, that failed
  std::shared_ptr<const CheckedWorld> world;  // the version that was made
};

SceneEditor::SceneEditor(std::unique_ptr<WorldEditor> editor, const DescribedScene& described,
                         const MonitorParameters& parameters, const Parts& parts, std::function<void()> wake,
                         std::function<void(const CheckedWorld&)> changed)
    : editor_(std::move(editor)),
      parts_(parts),
      files_(parameters.resource_roots,
             [](const std::string& uri) { return loadLocalResource(uri, ros::package::getPath, ""); }),
      request_time_(parameters.request_time),
      wake_(std::move(wake)),
      changed_(std::move(changed)),
      handover_([this](PreparedWorld& prepared) {
        const std::shared_ptr<const CheckedWorld> world = prepared.loop->world;
        parts_.loop.adopt(*prepared.loop);
        parts_.outputs.adopt(*prepared.outputs);
        parts_.queries.setWorld(world);
      }),
      requests_(kMaxCallers, "changes of the scene are being made"),
      scene_(std::make_shared<const ChangingScene>(
          startUpScene(described, parameters, parts.loop.world()->description()))),
      last_(parts.loop.world()) {}

SceneEditor::~SceneEditor() = default;

/// Builds the bodies of the draft that the last version does not have.
void SceneEditor::build(Draft& draft) {
  draft.arena.run([&] {
    SceneDescription description = draft.scene.description(limits_);
    // With a body that stands for the tiles to come: no map is to wait until bodies are prepared for its first tile.
    const auto is_tile = [](const BodyDescription& body) { return !body.map.empty(); };
    if (description.has_live_map && std::none_of(description.bodies.begin(), description.bodies.end(), is_tile))
      description.bodies.push_back(awaitedTile(parts_.loop.fixedFrame(), "to come"));
    draft.parts = editor_->prepare(description, [&](const std::string& body) { draft.making = body; });
  });
}

/// Makes the draft's version, with what others have changed since, and hands it over to the cycles.
void SceneEditor::commit(Draft& draft) {
  while (!makeNext(draft)) build(draft);
  wake_();
  if (draft.changer == Changer::kRequest)
    parts_.loop.warnings().set("requests", draft.scene.weakened(draft.world->description()));
  changed_(*draft.world);
}

/// @return false if bodies have to be built first, because others have changed the scene.
bool SceneEditor::makeNext(Draft& draft) {
  const Turn turn(*this, draft.changer);
  ChangingScene last = *scene();
  if (draft.changer == Changer::kRequest) {
    draft.scene.setTilesOf(last);
    draft.scene.setForcesOf(last);
  } else {
    draft.changer == Changer::kMap ? last.setTilesOf(draft.scene) : last.setForcesOf(draft.scene);
    draft.scene = std::move(last);
  }
  draft.arena.run([&] {
    const auto snapshot = editor_->next(draft.scene.description(limits_), *draft.parts);
    if (!snapshot) return;
    const auto world = std::make_shared<CheckedWorld>(snapshot, draft.scene.objects());
    world->map_age = draft.scene.mapAge();
    draft.world = world;
  });
  if (!draft.world) return false;
  std::unique_ptr<PreparedWorld> waiting = handover_.withdraw();
  try {
    handover_.offer(prepare(draft.world, draft.arena));
  } catch (...) {
    if (waiting) handover_.offer(std::move(waiting));
    throw;
  }
  const std::lock_guard<std::mutex> lock(last_mutex_);
  scene_ = std::make_shared<const ChangingScene>(draft.scene);
  last_ = draft.world;
  return true;
}

std::unique_ptr<PreparedWorld> SceneEditor::prepare(const std::shared_ptr<const CheckedWorld>& world,
                                                    WorkArena& arena) {
  auto prepared = std::make_unique<PreparedWorld>();
  prepared->version = world->version();
  arena.run([&] { prepared->loop = parts_.loop.prepare(world); });
  prepared->outputs = parts_.outputs.prepare(*world);
  return prepared;
}

std::shared_ptr<const ChangingScene> SceneEditor::scene() {
  const std::lock_guard<std::mutex> lock(last_mutex_);
  return scene_;
}

void SceneEditor::save(const std::string& file, const ChangingScene& scene, ChangeSources& sources) {
  if (std::filesystem::path(sources.files.path(file)).extension() != ".scene")
    throw std::invalid_argument("save_file " + file + " does not end in .scene");
  sources.files.write(file, sceneText(scene, sources.history, sources.warnings));
}

void SceneEditor::edit(const UpdateScene::Request& request, UpdateScene::Response& response, std::string& making) {
  const auto start = Clock::now();
  Draft draft{Changer::kRequest, *scene(), arena_, nullptr, {}, nullptr};
  ChangeSources sources{parts_.loop.history(), files_, limits_, limits_.triangles, {}, ros::Time::now()};
  if (request.changes.size() > limits_.objects)
    throw std::invalid_argument("more than " + std::to_string(limits_.objects) + " changes in one request");
  for (const SceneChange& change : request.changes) {
    response.failed_change = static_cast<std::int32_t>(&change - request.changes.data());
    apply(change, sources, draft.scene);
  }
  response.failed_change = -1;
  try {
    if (!request.changes.empty()) build(draft);
  } catch (const std::invalid_argument&) {
    response.failed_change = lastChangeOf(draft.making, request);
    throw;
  } catch (const Cancelled&) {
    response.failed_change = lastChangeOf(draft.making, request);
    making = draft.making;
    throw;
  }
  if (!request.changes.empty()) parts_.outputs.advertise(draft.scene.description(limits_), world()->description());
  if (!request.save_file.empty()) save(request.save_file, draft.scene, sources);
  response.adopted = true;
  if (!request.changes.empty()) {
    commit(draft);
    response.seconds = secondsSince(start);
    const auto ready = Clock::now();
    response.adopted = handover_.waitFor(draft.world->version());
    response.adopt_seconds = secondsSince(ready);
    parts_.queries.dropUnused();
    response.prepared = static_cast<std::uint32_t>(draft.world->snapshot->prepared);
    response.shared = static_cast<std::uint32_t>(draft.world->snapshot->shared);
    const std::vector<std::string>& made = draft.world->snapshot->warnings;
    sources.warnings.insert(sources.warnings.end(), made.begin(), made.end());
  }
  for (const std::string& warning : sources.warnings) response.message += warning + "\n";
  response.success = true;
}

std::shared_ptr<const CheckedWorld> SceneEditor::world() {
  const std::lock_guard<std::mutex> lock(last_mutex_);
  return last_;
}

void SceneEditor::addForces(const std::vector<std::string>& bodies, WorkArena& arena) {
  lowerPriority();
  Draft draft{Changer::kForces, *scene(), arena, nullptr, {}, nullptr};
  draft.scene.setForces(bodies, Forces::kKnown);
  for (bool is_built = false; !is_built;) {
    draft.making.clear();
    try {
      build(draft);
      is_built = true;
    } catch (const std::invalid_argument& problem) {
      if (draft.making.empty()) throw;
      ROS_WARN("No forces of %s", problem.what());
      draft.scene.setForces({draft.making}, Forces::kFailed);
    }
  }
  commit(draft);
  handover_.waitFor(draft.world->version());
}

std::uint64_t SceneEditor::setMap(std::vector<BodyDescription> tiles, TileObjects objects, std::shared_ptr<MapAge> age,
                                  WorkArena& arena) {
  lowerPriority();
  Draft draft{Changer::kMap, *scene(), arena, nullptr, {}, nullptr};
  draft.scene.setTiles(std::move(tiles), std::move(objects), std::move(age));
  build(draft);
  commit(draft);
  handover_.waitFor(draft.world->version());
  return draft.world->version();
}

void SceneEditor::update(const UpdateScene::Request& request, UpdateScene::Response& response) {
  lowerPriority();
  response.failed_change = -1;
  const CancelPoint monitor;
  std::string making;
  try {
    const CancelScope scope(Clock::now() +
                            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(request_time_)));
    const WorkTurns::Caller registered(requests_);
    const WorkTurns::Turn turn(requests_);
    edit(request, response, making);
  } catch (const Cancelled&) {
    if (monitor.requested()) throw;
    response.success = false;
    response.message = "nothing has changed: the request has taken longer than " + numberText(request_time_) +
                       " s (parameter request_time)" +
                       (making.empty() ? "" : "; the time ended while " + making + " was built");
  } catch (const std::exception& error) {
    response.success = false;
    response.message = error.what();
  }
  response.scene_version = world()->version();
  const std::shared_ptr<const ChangingScene> now = scene();  // others may replace it meanwhile
  for (const auto& [name, object] : now->objects()) response.objects.push_back(name);
}

}  // namespace sdf_ccd
