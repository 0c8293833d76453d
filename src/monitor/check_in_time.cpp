// The test of a cycle's due pairs within a limit of time.
#include <algorithm>

#include <tbb/task_arena.h>

#include "common/cancel_point.h"
#include "common/parallel_for.h"
#include "common/processor_time.h"
#include "monitor_impl.h"

namespace sdf_ccd {
namespace {

/// A pair whose search ended in vain with all of the time comes last for so many cycles.
constexpr int kAfterVain = 8;

}  // namespace

/// Whether the pair's motion is known in this cycle. If not, its check tells why.
bool Monitor::Impl::isMotionKnown(const CycleMotion& motion, const DuePair& due) const {
  const PairResult& pair = result.pairs[static_cast<std::size_t>(due.pair)];
  const auto isKnown = [&](int body) { return bodies->whyUnknown(motion, body).empty(); };
  return !pair.span.empty() && isKnown(pair.body_a) && isKnown(pair.body_b);
}

/// Sets the queue of due pairs, those that have waited longest first. Pairs whose motion is not known need no time:
/// they come last, and have waited as long as before when it is known again. @return the number of the others.
std::size_t Monitor::Impl::orderQueue(const CycleMotion& motion) {
  queue = schedule->due();
  const auto unknown =
      std::partition(queue.begin(), queue.end(), [&](const DuePair& due) { return isMotionKnown(motion, due); });
  const auto waitedFor = [&](const DuePair& due) { return known.pairs[static_cast<std::size_t>(due.pair)]->waited; };
  std::sort(queue.begin(), unknown, [&](const DuePair& a, const DuePair& b) {
    if (waitedFor(a) != waitedFor(b)) return waitedFor(a) > waitedFor(b);
    return a.left != b.left ? a.left < b.left : a.pair < b.pair;
  });
  return static_cast<std::size_t>(unknown - queue.begin());
}

/// Sets a pair's result; postpones the pair if there is no verdict until then.
void Monitor::Impl::checkUntil(Clock::time_point until, const DuePair& due, const CycleMotion& motion,
                               const CycleRequest& request, PairMemory& pair_memory) {
  const auto i = static_cast<std::size_t>(due.pair);
  const PairCycle cycle_of_pair = cycleOf(motion, request, pair_memory);
  bool is_decided = false;
  if (Clock::now() < until) {
    checkCancelled();
    pair_memory.deadline = until;
    try {
      checkPair(cycle_of_pair, *known.pairs[i], result.pairs[i]);
      is_decided = true;
    } catch (const Cancelled&) {
      checkCancelled();
    }
  }
  if (!is_decided) postponePair(cycle_of_pair, due.left, *known.pairs[i], result.pairs[i]);
}

/// All threads take pairs from one queue, so that the most urgent ones are done first: verdicts, then what is missing
/// of contacts. The first pair has some time in any case, so that each is tested some time.
void Monitor::Impl::checkInTime(const CycleMotion& motion, const CycleRequest& request, Clock::time_point until) {
  constexpr auto kSomeTime = std::chrono::microseconds(300);
  const std::size_t with_motion = orderQueue(motion);
  const auto untilFor = [&](std::size_t k) { return k > 0 ? until : std::max(until, Clock::now() + kSomeTime); };
  const auto usedAll = [&](double seconds) {
    return seconds > 0.5 * std::max(request.max_time, std::chrono::duration<double>(kSomeTime).count());
  };
  const auto forEachInQueue = [&](const auto& visit) {
    std::atomic<std::size_t> next{0};
    const auto work = [&](int) {
      std::unique_ptr<PairMemory> taken = memory->acquire();
      for (std::size_t k = next++; k < queue.size(); k = next++)
        visit(k, static_cast<std::size_t>(queue[k].pair), *taken);
      taken->deadline = Clock::time_point::max();
      memory->giveBack(std::move(taken));
    };
    if (isSmall(queue)) return work(0);
    parallelFor(0, tbb::this_task_arena::max_concurrency(), work);
  };
  std::atomic<int> incomplete{0};
  forEachInQueue([&](std::size_t k, std::size_t i, PairMemory& pair_memory) {
    const double begin = k == 0 ? threadSeconds() : 0.0;
    checkUntil(untilFor(k), queue[k], motion, request, pair_memory);
    if (result.pairs[i].incomplete) ++incomplete;
    if (k >= with_motion || result.pairs[i].incomplete) return;
    const bool in_vain = k == 0 && result.pairs[i].postponed && usedAll(threadSeconds() - begin);
    int& waited = known.pairs[i]->waited;
    waited = in_vain ? -kAfterVain : result.pairs[i].postponed ? waited + 1 : 0;
  });
  if (incomplete == 0) return;
  std::atomic<int> before{0};
  forEachInQueue([&](std::size_t /*k*/, std::size_t i, PairMemory& pair_memory) {
    PairResult& pair = result.pairs[i];
    if (!pair.incomplete || !known.pairs[i]->is_to_complete) return;
    const bool is_first = before++ == 0;
    const Clock::time_point end = untilFor(is_first ? 0 : 1);
    if (Clock::now() < end) {
      checkCancelled();
      pair_memory.deadline = end;
      completePair(cycleOf(motion, request, pair_memory), *known.pairs[i], pair);
      if (pair.incomplete) checkCancelled();
    }
    int& waited = known.pairs[i]->waited;
    waited = pair.incomplete && !is_first ? waited + 1 : 0;
  });
}

}  // namespace sdf_ccd
