#include "sdf_ccd/monitor/monitor.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "common/number_text.h"
#include "common/parallel_for.h"
#include "model/error_budget.h"
#include "pair_checker.h"
#include "sdf_ccd/common/cancel.h"
#include "summarise.h"

namespace sdf_ccd {
namespace {

std::vector<ContactCollector::Siblings> siblingsOf(const Scene& scene) {
  std::vector<ContactCollector::Siblings> siblings(scene.bodies.size());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const std::vector<BodyPart>& parts = scene.bodies[b].parts;
    siblings[b].resize(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (k != i) siblings[b][i].push_back({&parts[k].field, parts[k].X_BG.inverse() * parts[i].X_BG, k < i});
  }
  return siblings;
}

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("cycle motion: " + what);
}

void validate(const CycleMotion& motion, const Scene& scene) {
  const std::size_t bodies = scene.bodies.size();
  if (motion.times.size() < 2) refuse(std::to_string(motion.times.size()) + " times, two or more are needed");
  if (motion.times.front() != 0.0) refuse("starts at " + numberText(motion.times.front()) + " s, not 0");
  for (std::size_t k = 1; k < motion.times.size(); ++k) {
    const double last = motion.times[k - 1], time = motion.times[k];
    if (!(last < time) || !std::isfinite(time))
      refuse("time " + numberText(last) + " s is followed by " + numberText(time));
  }
  const std::size_t pairs = scene.pairs.size();
  if (!motion.spans.empty() && motion.spans.size() != pairs)
    refuse(std::to_string(motion.spans.size()) + " spans, the scene has " + std::to_string(pairs) + " pairs");
  for (const WaypointSpan& span : motion.spans)
    if (span.first > span.last || span.last >= motion.times.size())
      refuse("a span from time " + std::to_string(span.first) + " to " + std::to_string(span.last));
  const auto fits = [&](std::size_t size) { return size == 0 || size == bodies; };
  if (motion.X_WB.size() != bodies || !fits(motion.missing.size()) || !fits(motion.motion_error.size()))
    refuse("made for " + std::to_string(motion.X_WB.size()) + " bodies, the scene has " + std::to_string(bodies));
  for (std::size_t b = 0; b < bodies; ++b) {
    const std::string& name = scene.bodies[b].name;
    const bool known = scene.bodies[b].failure.empty() && (motion.missing.empty() || motion.missing[b].empty());
    if (known && motion.X_WB[b].size() != motion.times.size())
      refuse(name + " has " + std::to_string(motion.X_WB[b].size()) + " poses at " +
             std::to_string(motion.times.size()) + " times");
    if (motion.motion_error.empty()) continue;
    const double error = motion.motion_error[b];
    if (!(error >= 0.0)) refuse("motion error of " + name + " is " + numberText(error));
  }
}

}  // namespace

/// Taken for some pairs and given back, so there are as many as threads check pairs at a time; the last one given back
/// is taken first.
struct MonitorMemory {
  std::unique_ptr<PairMemory> take() {
    const std::lock_guard<std::mutex> lock(mutex);
    if (idle.empty()) return std::make_unique<PairMemory>();
    std::unique_ptr<PairMemory> last = std::move(idle.back());
    idle.pop_back();
    return last;
  }
  void giveBack(std::unique_ptr<PairMemory> memory) {
    const std::lock_guard<std::mutex> lock(mutex);
    idle.push_back(std::move(memory));
  }

  std::mutex mutex;
  std::vector<std::unique_ptr<PairMemory>> idle;
};

std::shared_ptr<MonitorMemory> makeMonitorMemory() {
  return std::make_shared<MonitorMemory>();
}

struct Monitor::Impl {
  std::shared_ptr<const Scene> scene;
  MonitorOptions options;
  std::vector<ContactCollector::Siblings> siblings;
  std::vector<PairChecker> checkers;
  std::unique_ptr<SweptBodies> bodies;
  std::shared_ptr<MonitorMemory> memory;
  CycleResult result;
};

Monitor::Monitor(std::shared_ptr<const Scene> scene, const MonitorOptions& options,
                 std::shared_ptr<MonitorMemory> memory)
    : impl_(new Impl) {
  validate(options.contact);
  if (!(options.chords.tolerance > 0.0) || !std::isfinite(options.chords.tolerance))
    throw std::invalid_argument("monitor: chord tolerance " + numberText(options.chords.tolerance) + " m");
  if (options.chords.max_chords < 1)
    throw std::invalid_argument("monitor: max_chords " + std::to_string(options.chords.max_chords));
  if (!scene) throw std::invalid_argument("monitor: no scene");
  impl_->scene = std::move(scene);
  impl_->options = options;
  impl_->memory = memory ? std::move(memory) : makeMonitorMemory();
  impl_->siblings = siblingsOf(*impl_->scene);
  impl_->bodies = std::make_unique<SweptBodies>(*impl_->scene);
  for (const PlannedPair& pair : impl_->scene->pairs) {
    impl_->checkers.emplace_back(*impl_->scene, pair, impl_->siblings, impl_->options);
    PairResult result;
    result.body_a = pair.body_a;
    result.body_b = pair.body_b;
    impl_->result.pairs.push_back(result);
  }
}

Monitor::Monitor(std::vector<Body> bodies, const MonitorOptions& options)
    : Monitor(
          std::make_shared<const Scene>(makeScene(std::move(bodies), ErrorBudget::kChords * options.chords.tolerance)),
          options) {}

Monitor::~Monitor() = default;

const CycleResult& Monitor::run(const CycleMotion& motion, const CycleRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  validate(motion, *impl_->scene);
  const WaypointSpan whole{0, motion.times.size() - 1};
  std::vector<PairResult>& pairs = impl_->result.pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].span = motion.spans.empty() ? whole : motion.spans[i];
  impl_->bodies->take(motion, pairs);
  // A pair has its own state, so its result is the same whichever thread it meets.
  parallelRanges(std::size_t{0}, impl_->checkers.size(), [&](std::size_t first, std::size_t last) {
    std::unique_ptr<PairMemory> memory = impl_->memory->take();
    for (std::size_t i = first; i < last; ++i) {
      checkCancelled();
      impl_->checkers[i].run(motion, *impl_->bodies, request, *memory, pairs[i]);
    }
    impl_->memory->giveBack(std::move(memory));
  });
  summarise(impl_->result);
  impl_->result.run_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return impl_->result;
}

const CycleResult& Monitor::check(const std::vector<std::vector<Isometry3d>>& X_WB, double duration,
                                  const CycleRequest& request) {
  CycleMotion motion;
  const std::size_t count = X_WB.empty() ? 0 : X_WB.front().size();
  for (std::size_t k = 0; k < count; ++k)
    motion.times.push_back(k == 0 ? 0.0 : duration * static_cast<double>(k) / static_cast<double>(count - 1));
  motion.X_WB = X_WB;
  for (std::size_t b = 0; b < X_WB.size() && b < scene().bodies.size(); ++b)
    requireUnambiguousTurns(X_WB[b], "monitor: " + scene().bodies[b].name);
  return run(motion, request);
}

void Monitor::reset() {
  for (PairChecker& checker : impl_->checkers) checker.forget();
}

const Scene& Monitor::scene() const {
  return *impl_->scene;
}

}  // namespace sdf_ccd
