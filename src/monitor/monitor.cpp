#include "sdf_ccd/monitor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/cancel_point.h"
#include "common/number_text.h"
#include "common/parallel_for.h"
#include "common/seconds_since.h"
#include "monitor/monitor_memory.h"
#include "monitor/shared_memory.h"
#include "monitor_impl.h"
#include "pair_result.h"
#include "pair_times.h"
#include "scene/error_budget.h"
#include "summarise.h"

namespace sdf_ccd {
namespace {

void requireMargin(double margin) {
  if (margin >= 0.0 && margin <= kLargestMargin) return;
  throw std::invalid_argument("a margin must be from 0 to " + numberText(kLargestMargin) + " m, not " +
                              numberText(margin) + " m");
}

}  // namespace

std::shared_ptr<MonitorMemory> makeMonitorMemory() {
  return std::make_shared<MonitorMemory>();
}

Monitor::Impl::Impl(std::shared_ptr<const Scene> of_scene, const MonitorOptions& with_options,
                    std::shared_ptr<MonitorMemory> shared_memory, Known shared)
    : scene(std::move(of_scene)),
      options(with_options),
      known(std::move(shared)),
      bodies(std::make_unique<SweptBodies>(*scene)),
      memory(std::move(shared_memory)) {
  known.bodies.resize(scene->bodies.size());
  for (std::size_t b = 0; b < known.bodies.size(); ++b)
    if (!known.bodies[b]) known.bodies[b] = std::make_shared<const MonitoredBody>(scene->bodies.shared(b));
  const std::size_t count = scene->pairs.size();
  known.pairs.resize(count);
  result.pairs.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const PlannedPair& pair = scene->pairs[i];
    const auto &a = known.bodies[static_cast<std::size_t>(pair.body_a)],
               &b = known.bodies[static_cast<std::size_t>(pair.body_b)];
    if (!known.pairs[i]) known.pairs[i] = std::make_shared<MonitoredPair>(a, b, pair, options.max_error);
    result.pairs[i].body_a = pair.body_a;
    result.pairs[i].body_b = pair.body_b;
  }
  schedule = std::make_unique<Schedule>(*scene, known.pairs);
  is_failed.assign(count, 0);
  for (const int pair : schedule->failed()) {
    const PlannedPair& planned = scene->pairs[static_cast<std::size_t>(pair)];
    const std::string& why = scene->bodies[planned.body_a].failure;
    clear(result.pairs[static_cast<std::size_t>(pair)]);
    setNotChecked(why.empty() ? scene->bodies[planned.body_b].failure : why,
                  result.pairs[static_cast<std::size_t>(pair)]);
    is_failed[static_cast<std::size_t>(pair)] = 1;
  }
  result.failed = schedule->failed();
  due_in_cycle.assign(count, 0);
  last_due.reserve(count);
  queue.reserve(count);
  result.not_clear.reserve(count);
  shape.pairs = count;
  for (const Body& body : scene->bodies) {
    shape.bodies.push_back(body.name);
    shape.without_poses.push_back(!body.failure.empty());
  }
}

Monitor::Impl::Known Monitor::Impl::knownOf(const Scene& next, const SceneDifference& difference) const {
  Known shared;
  for (const int before : difference.bodiesBefore())
    shared.bodies.push_back(before < 0 ? nullptr : known.bodies[static_cast<std::size_t>(before)]);
  shared.pairs.resize(next.pairs.size());
  for (std::size_t i = 0; i < known.pairs.size(); ++i) {
    const int now = difference.pairsNow()[i];
    if (now >= 0) shared.pairs[static_cast<std::size_t>(now)] = known.pairs[i];
  }
  return shared;
}

Monitor::Monitor(std::shared_ptr<const Scene> scene, const MonitorOptions& options,
                 std::shared_ptr<MonitorMemory> memory) {
  validate(options.contact);
  if (!(options.chords.tolerance > 0.0) || !std::isfinite(options.chords.tolerance))
    throw std::invalid_argument("monitor: chord tolerance " + numberText(options.chords.tolerance) + " m");
  if (options.chords.max_chords < 1)
    throw std::invalid_argument("monitor: max_chords " + std::to_string(options.chords.max_chords));
  if (!(options.max_error >= kMinMaxError && options.max_error <= kLargestMaxError))
    throw std::invalid_argument("monitor: max_error must be from " + numberText(kMinMaxError) + " to " +
                                numberText(kLargestMaxError) + " m, not " + numberText(options.max_error));
  if (!scene) throw std::invalid_argument("monitor: no scene");
  impl_ = std::make_unique<Impl>(std::move(scene), options, memory ? std::move(memory) : makeMonitorMemory());
}

Monitor::Monitor(std::vector<Body> bodies, const MonitorOptions& options)
    : Monitor(
          std::make_shared<const Scene>(makeScene(std::move(bodies), ErrorBudget::kChords * options.chords.tolerance)),
          options) {}

Monitor::~Monitor() = default;

const CycleResult& Monitor::run(const CycleMotion& motion, const CycleRequest& request) {
  validate(motion, impl_->shape, "cycle motion");
  requireMargin(request.margin);
  try {
    return impl_->run(motion, request);
  } catch (...) {
    reset();
    throw;
  }
}

/// When the cycle's time is used up; never, if it is longer than the clock counts.
Monitor::Impl::Clock::time_point Monitor::Impl::endOf(const CycleRequest& request, Clock::time_point start) {
  constexpr double kAYear = 3e7;  // [s]
  if (!(request.max_time > 0.0 && request.max_time < kAYear)) return Clock::time_point::max();
  return start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(request.max_time));
}

const CycleResult& Monitor::Impl::run(const CycleMotion& motion, const CycleRequest& request) {
  const auto start = Clock::now();
  schedule->findDue(motion, request.margin, known.pairs);
  takeSpans(motion);
  takeSkipped(request);
  checkDue(motion, request, start);
  measureSoon(motion, endOf(request, start));
  schedule->finish(motion, known.pairs);
  summarise(motion.times.size() - 1);
  result.run_time = secondsSince(start);
  return result;
}

/// Results of pairs that are not due keep their spans if these are the same as in the last cycle.
void Monitor::Impl::takeSpans(const CycleMotion& motion) {
  const WaypointSpan whole{0, motion.times.size() - 1};
  const bool all_whole = schedule->isAllWhole();
  if (all_whole && last_waypoint == whole.last) return;
  for (std::size_t i = 0; i < result.pairs.size(); ++i) result.pairs[i].span = is_failed[i] ? whole : motion.span(i);
  last_waypoint = all_whole ? whole.last : 0;
}

/// Sets the results of pairs that were due in the last cycle and are not in this one. Sets those of all pairs that are
/// not due if the request wants them, or if the last one did.
void Monitor::Impl::takeSkipped(const CycleRequest& request) {
  ++cycle;
  for (const DuePair& due : schedule->due()) due_in_cycle[static_cast<std::size_t>(due.pair)] = cycle;
  const auto setQuiet = [&](std::size_t i) {
    if (due_in_cycle[i] != cycle && !is_failed[i]) setSkipped(errorOf(static_cast<int>(i)), result.pairs[i]);
  };
  for (const int pair : last_due) setQuiet(static_cast<std::size_t>(pair));
  for (std::size_t i = 0; i < known.pairs.size() && are_of_cycle && !request.skipped_pairs; ++i) setQuiet(i);
  are_of_cycle = request.skipped_pairs;
  last_due.clear();
  for (const DuePair& due : schedule->due()) last_due.push_back(due.pair);
  if (!request.skipped_pairs) return;
  for (std::size_t i = 0; i < known.pairs.size(); ++i) {
    if (due_in_cycle[i] == cycle || is_failed[i]) continue;
    result.pairs[i].error = errorOf(static_cast<int>(i));
    result.pairs[i].clearance = schedule->clearance(static_cast<int>(i)) - schedule->motionError(static_cast<int>(i));
  }
}

/// For a pair that is not due.
ErrorSources Monitor::Impl::errorOf(int pair) const {
  return {0.0, schedule->motionError(pair), 0.0, known.pairs[static_cast<std::size_t>(pair)]->verdict.deviation()};
}

void Monitor::Impl::check(const DuePair& due, const CycleMotion& motion, const CycleRequest& request,
                          PairMemory& pair_memory) {
  checkCancelled();
  const auto i = static_cast<std::size_t>(due.pair);
  const PairTimes::Measure measure(request.times, due.pair);
  const PairCycle cycle_of_pair = cycleOf(motion, request, pair_memory);
  checkPair(cycle_of_pair, *known.pairs[i], result.pairs[i]);
  completePair(cycle_of_pair, *known.pairs[i], result.pairs[i]);
  if (result.pairs[i].incomplete) checkCancelled();
}

/// A few pairs that were clear the last time take less time than handing them to other threads.
bool Monitor::Impl::isSmall(const std::vector<DuePair>& due) const {
  constexpr std::size_t kFew = 8;
  if (due.size() > kFew) return false;
  const auto near = std::count_if(due.begin(), due.end(), [&](const DuePair& next) {
    return mayTouch(result.pairs[static_cast<std::size_t>(next.pair)].verdict);
  });
  return due.size() == 1 || near <= 1;
}

void Monitor::Impl::checkDue(const CycleMotion& motion, const CycleRequest& request, Clock::time_point start) {
  const std::vector<DuePair>& due = schedule->due();
  if (due.empty()) return;
  bodies->sweepDue(motion, result.pairs, due);
  if (request.max_time > 0.0) return checkInTime(motion, request, endOf(request, start));
  const auto checkRange = [&](std::size_t first, std::size_t last) {
    std::unique_ptr<PairMemory> taken = memory->acquire();
    for (std::size_t k = first; k < last; ++k) check(due[k], motion, request, *taken);
    memory->giveBack(std::move(taken));
  };
  if (isSmall(due)) return checkRange(0, due.size());
  // Each pair has its own state, so its result does not depend on the thread.
  parallelRanges(std::size_t{0}, due.size(), checkRange);
}

/// Uses a cycle without a due pair to measure one that would be due next: otherwise many may be due at the same time.
void Monitor::Impl::measureSoon(const CycleMotion& motion, Clock::time_point until) {
  const int pair = schedule->dueNext();
  if (pair < 0 || !schedule->due().empty()) return;
  const CancelScope scope(until);
  const auto i = static_cast<std::size_t>(pair);
  queue.assign(1, {0.0F, pair});
  bodies->sweepDue(motion, result.pairs, queue);
  std::unique_ptr<PairMemory> taken = memory->acquire();
  std::optional<double> clearance;
  try {
    clearance = measureClearance(cycleOf(motion, {}, *taken), *known.pairs[i], result.pairs[i]);
  } catch (const std::exception&) {  // the cycle's results are complete without it
  } catch (const Cancelled&) {
  }
  memory->giveBack(std::move(taken));
  schedule->raiseDueNext(clearance);
}

void Monitor::Impl::summarise(std::size_t end) {
  CycleSummary summary(result, end);
  for (const DuePair& due : schedule->due()) summary.add(due.pair);
  ErrorSources worst;
  if (schedule->worstSkipped() >= 0) {
    worst = errorOf(schedule->worstSkipped());
    worst.chord += std::max(0.0, schedule->worstError() - worst.total());
  }
  summary.addSkipped(schedule->skippedCount(), worst);
  summary.addFailed();
  summary.finish();
}

void Monitor::Impl::forget() {
  schedule->forget();
  for (const auto& pair : known.pairs) pair->forget();
}

const CycleResult& Monitor::check(const std::vector<std::vector<Isometry3d>>& X_WB, double duration,
                                  const CycleRequest& request) {
  CycleMotion motion;
  const std::size_t count = X_WB.empty() ? 0 : X_WB.front().size();
  for (std::size_t k = 0; k < count; ++k)
    motion.times.push_back(k == 0 ? 0.0 : duration * static_cast<double>(k) / static_cast<double>(count - 1));
  motion.X_WB = X_WB;
  for (std::size_t b = 0; b < X_WB.size() && b < scene().bodies.size(); ++b) {
    const std::string& name = scene().bodies[b].name;
    if (X_WB[b].size() != count && scene().bodies[b].failure.empty())
      throw std::invalid_argument("monitor: " + name + " has " + std::to_string(X_WB[b].size()) +
                                  " poses, others have " + std::to_string(count));
    requireUnambiguousTurns(X_WB[b], "monitor: " + name);
  }
  return run(motion, request);
}

void Monitor::reset() {
  impl_->forget();
}

const Scene& Monitor::scene() const {
  return *impl_->scene;
}

}  // namespace sdf_ccd
