#include <chrono>
#include <stdexcept>
#include <utility>

#include "common/cancel_point.h"
#include "monitor_impl.h"
#include "pair_result.h"
#include "scene_difference.h"

namespace sdf_ccd {
namespace {

constexpr double kTestTime = 0.1;  // for new pairs in advance [s]: what is left, the next cycle tests
constexpr std::chrono::milliseconds kLongestTest(200);

}  // namespace

/// The monitor of the next scene. It shares what is known of the pairs that the present one has too.
struct MonitorChange::Impl {
  std::shared_ptr<const Scene> before;
  SceneDifference difference;
  std::unique_ptr<Monitor::Impl> monitor;

  bool testNewPairs(CycleMotion motion);
};

MonitorChange::MonitorChange(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MonitorChange::~MonitorChange() = default;

const SceneDifference& MonitorChange::difference() const {
  return impl_->difference;
}

/// Whoever prepares a change may hold up others, and a single pair can take long: then the next cycle has to test them.
/// @return whether that took not too long.
bool MonitorChange::Impl::testNewPairs(CycleMotion motion) {
  const std::vector<int>& new_pairs = difference.newPairs();
  if (new_pairs.empty() || motion.times.empty()) return true;
  motion.spans.assign(monitor->result.pairs.size(), WaypointSpan());
  for (const int pair : new_pairs) motion.spans[static_cast<std::size_t>(pair)] = {0, motion.times.size() - 1};
  validate(motion, monitor->shape, "cycle motion");
  CycleRequest request{false, 0, false, false};
  request.max_time = kTestTime;
  try {
    const CancelScope scope(CancelRequest::Clock::now() + kLongestTest);
    monitor->run(motion, request);
  } catch (const Cancelled&) {
    checkCancelled();
    return false;
  }
  monitor->last_due = new_pairs;  // not the others, which were delayed
  return true;
}

std::unique_ptr<MonitorChange> Monitor::prepare(std::shared_ptr<const Scene> next, const CycleMotion* likely) const {
  if (!next) throw std::invalid_argument("monitor: no scene");
  auto change = std::make_unique<MonitorChange::Impl>(
      MonitorChange::Impl{impl_->scene, SceneDifference(*impl_->scene, *next), nullptr});
  const auto make = [&] {
    change->monitor =
        std::make_unique<Impl>(next, impl_->options, impl_->memory, impl_->knownOf(*next, change->difference));
  };
  make();
  if (likely && !change->testNewPairs(*likely)) make();
  Impl& monitor = *change->monitor;

  // Common pairs that are not tested in the next cycle are clear; all others are set by their tests.
  const std::size_t last = impl_->last_waypoint;
  monitor.last_waypoint = last;
  for (PairResult& result : monitor.result.pairs)
    if (last > 0) result.span = {0, last};
  for (const int now : change->difference.pairsNow()) {
    if (now < 0 || monitor.is_failed[static_cast<std::size_t>(now)]) continue;
    const auto i = static_cast<std::size_t>(now);
    setSkipped({0.0, 0.0, 0.0, monitor.known.pairs[i]->verdict.deviation()}, monitor.result.pairs[i]);
  }
  return std::unique_ptr<MonitorChange>(new MonitorChange(std::move(change)));
}

void Monitor::adopt(MonitorChange& change) {
  MonitorChange::Impl& made = *change.impl_;
  if (made.before != impl_->scene) throw std::logic_error("monitor: the change was prepared from another scene");
  Impl& next = *made.monitor;
  next.schedule->adopt(*impl_->schedule, made.difference);
  for (const int pair : impl_->last_due) {
    const int now = made.difference.pairsNow()[static_cast<std::size_t>(pair)];
    if (now < 0) continue;
    const auto from = static_cast<std::size_t>(pair), to = static_cast<std::size_t>(now);
    const int body_a = next.result.pairs[to].body_a, body_b = next.result.pairs[to].body_b;
    const WaypointSpan span = next.result.pairs[to].span;
    std::swap(next.result.pairs[to], impl_->result.pairs[from]);
    next.result.pairs[to].body_a = body_a;
    next.result.pairs[to].body_b = body_b;
    next.result.pairs[to].span = span;
    next.last_due.push_back(now);
  }
  impl_.swap(made.monitor);
  made.before.reset();  // prevents a second adopt()
}

}  // namespace sdf_ccd
