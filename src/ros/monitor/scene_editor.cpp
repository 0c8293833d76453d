#include "ros/monitor/scene_editor.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include <ros/package.h>

#include "common/seconds_since.h"
#include "ros/monitor/low_priority.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMaxCallers = 3;  // one that changes the scene, and others that wait
constexpr auto kPollPeriod = std::chrono::microseconds(200);
constexpr auto kMaxAdoptWait = std::chrono::milliseconds(500);  // longest wait for a cycle to adopt a version

int lastChangeOf(const std::string& object, const UpdateScene::Request& request) {
  for (auto change = request.changes.rbegin(); change != request.changes.rend(); ++change)
    if (change->object == object) return static_cast<int>(request.changes.rend() - change) - 1;
  return -1;
}

}  // namespace

/// The exclusive right of one caller to change the scene, for its lifetime.
class SceneEditor::EditLock {
 public:
  explicit EditLock(SceneEditor& editor) : editor_(editor) {
    if (++editor.callers_ > kMaxCallers) {
      --editor.callers_;
      throw std::runtime_error("busy: " + std::to_string(kMaxCallers) +
                               " changes of the scene are being made; try again later");
    }
    try {
      while (!editor.edit_mutex_.try_lock_for(std::chrono::milliseconds(20))) checkCancelled();
    } catch (...) {
      --editor.callers_;
      throw;
    }
  }
  ~EditLock() {
    editor_.edit_mutex_.unlock();
    --editor_.callers_;
  }
  EditLock(const EditLock&) = delete;
  EditLock& operator=(const EditLock&) = delete;

 private:
  SceneEditor& editor_;
};

SceneEditor::SceneEditor(std::unique_ptr<WorldEditor> editor, const DescribedScene& described,
                         const MonitorParameters& parameters, const Parts& parts, std::function<void()> wake,
                         std::function<void(const CheckedWorld&)> changed)
    : editor_(std::move(editor)),
      parts_(parts),
      files_(parameters.resource_roots, makeResourceLoader(ros::package::getPath, "", parameters.allow_http)),
      wake_(std::move(wake)),
      changed_(std::move(changed)),
      scene_(described, parameters.pairs, parts.loop.world()->description()),
      last_(parts.loop.world()) {}

SceneEditor::~SceneEditor() = default;

bool SceneEditor::adopt() {
  PreparedWorld* const ready = pending_.exchange(nullptr);
  if (!ready) return false;
  try {
    const std::shared_ptr<const CheckedWorld> world = ready->loop->world;
    parts_.loop.adopt(*ready->loop);
    parts_.outputs.adopt(*ready->outputs);
    parts_.queries.setWorld(world);
  } catch (...) {
    adopted_ = ready;  // otherwise withdraw() would wait forever
    throw;
  }
  adopted_ = ready;
  return true;
}

/// Withdraws the version that was handed over last if the cycles have not taken it, else waits until they have adopted
/// it; then frees its parts.
void SceneEditor::withdraw() {
  if (!handed_over_) return;
  if (!pending_.exchange(nullptr)) {
    while (adopted_ != handed_over_.get()) std::this_thread::sleep_for(kPollPeriod);
  }
  adopted_ = nullptr;
  handed_over_.reset();
}

std::unique_ptr<PreparedWorld> SceneEditor::prepare(const std::shared_ptr<const CheckedWorld>& world) {
  withdraw();
  auto prepared = std::make_unique<PreparedWorld>();
  arena_.run([&] { prepared->loop = parts_.loop.prepare(world); });
  prepared->outputs = parts_.outputs.prepare(*world);
  return prepared;
}

bool SceneEditor::handOver(std::unique_ptr<PreparedWorld> prepared) {
  handed_over_ = std::move(prepared);
  pending_ = handed_over_.get();
  wake_();
  const CancelPoint cancel;
  for (const auto start = Clock::now();
       adopted_ != handed_over_.get() && Clock::now() - start < kMaxAdoptWait && !cancel.requested();)
    std::this_thread::sleep_for(kPollPeriod);
  const bool is_adopted = adopted_ == handed_over_.get();
  if (is_adopted) withdraw();  // frees the former version
  return is_adopted;
}

/// @param making  receives the name of the body that is being made: after an exception, of the one that failed.
std::shared_ptr<const CheckedWorld> SceneEditor::make(const ChangingScene& scene, std::string& making) {
  std::shared_ptr<const CheckedWorld> world;
  arena_.run([&] {
    SceneDescription description = scene.description(limits_);
    std::vector<UnreachablePair> unreachable = scene.unreachable(description);
    world = std::make_shared<const CheckedWorld>(
        editor_->next(
            std::move(description), [&](const std::string& body) { making = body; },
            [](const std::string& cost) { ROS_INFO("The next version of the scene needs %s", cost.c_str()); }),
        std::move(unreachable), scene.attachedSince());
  });
  return world;
}

void SceneEditor::save(const std::string& file, const ChangingScene& scene, ChangeSources& sources) {
  if (std::filesystem::path(sources.files.path(file)).extension() != ".scene")
    throw std::invalid_argument("save_file " + file + " does not end in .scene");
  sources.files.write(file, scene.text(sources, sources.warnings));
}

void SceneEditor::edit(const UpdateScene::Request& request, UpdateScene::Response& response) {
  const auto start = Clock::now();
  ChangingScene scene = scene_;
  ChangeSources sources{parts_.loop.history(), files_, limits_, limits_.triangles, {}, ros::Time::now()};
  if (request.changes.size() > limits_.objects)
    throw std::invalid_argument("more than " + std::to_string(limits_.objects) + " changes in one request");
  for (const SceneChange& change : request.changes) {
    response.failed_change = static_cast<std::int32_t>(&change - request.changes.data());
    scene.apply(change, sources);
  }
  response.failed_change = -1;
  std::shared_ptr<const CheckedWorld> world = last_;
  std::unique_ptr<PreparedWorld> prepared;
  std::string making;
  try {
    if (!request.changes.empty()) world = make(scene, making);
  } catch (const std::invalid_argument&) {
    response.failed_change = lastChangeOf(making, request);
    throw;
  }
  if (!request.changes.empty()) prepared = prepare(world);
  if (!request.save_file.empty()) save(request.save_file, scene, sources);
  response.seconds = secondsSince(start);
  response.adopted = true;
  if (!request.changes.empty()) {
    const auto ready = Clock::now();
    response.adopted = commit(std::move(scene), world, std::move(prepared));
    response.adopt_seconds = secondsSince(ready);
    response.prepared = static_cast<std::uint32_t>(world->snapshot->prepared);
    response.shared = static_cast<std::uint32_t>(world->snapshot->shared);
    const std::vector<std::string>& made = world->snapshot->warnings;
    sources.warnings.insert(sources.warnings.end(), made.begin(), made.end());
  }
  for (const std::string& warning : sources.warnings) response.message += warning + "\n";
  response.success = true;
}

/// Makes this the scene, and hands its world over to the cycles. @return whether they have adopted it.
bool SceneEditor::commit(ChangingScene scene, const std::shared_ptr<const CheckedWorld>& world,
                         std::unique_ptr<PreparedWorld> prepared) {
  scene_ = std::move(scene);
  setLast(world);
  const bool is_adopted = handOver(std::move(prepared));
  changed_(*world);
  return is_adopted;
}

void SceneEditor::setLast(std::shared_ptr<const CheckedWorld> world) {
  const std::lock_guard<std::mutex> lock(last_mutex_);
  last_.swap(world);
}

std::shared_ptr<const CheckedWorld> SceneEditor::world() {
  const std::lock_guard<std::mutex> lock(last_mutex_);
  return last_;
}

std::uint64_t SceneEditor::setMap(std::vector<BodyDescription> tiles) {
  lowerPriority();
  const EditLock lock(*this);
  ChangingScene scene = scene_;
  scene.setTiles(std::move(tiles));
  std::string making;
  const std::shared_ptr<const CheckedWorld> world = make(scene, making);
  commit(std::move(scene), world, prepare(world));
  return world->version();
}

void SceneEditor::update(const UpdateScene::Request& request, UpdateScene::Response& response) {
  lowerPriority();
  response.failed_change = -1;
  try {
    const EditLock lock(*this);
    try {
      edit(request, response);
    } catch (const std::exception& error) {
      response.success = false;
      response.message = error.what();
    }
    response.scene_version = last_->version();
    response.objects = scene_.objects();
  } catch (const std::exception& error) {
    response.success = false;
    response.message = error.what();
  }
}

}  // namespace sdf_ccd
