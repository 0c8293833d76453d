#include "ros/monitor/work_arena.h"

#include <algorithm>
#include <chrono>

#include <tbb/flow_graph.h>

#include "common/cancel_point.h"
#include "ros/monitor/low_priority.h"

namespace sdf_ccd {

/// A helper's stay in the arena: one who waits for a graph does the arena's tasks meanwhile. The graph has no nodes.
struct WorkArena::Stay {
  tbb::flow::graph graph;  // of the arena in which it is made
};

/// Has the helpers in the arena while it lives.
class WorkArena::Working {
 public:
  explicit Working(WorkArena& arena) : arena_(arena) {
    {
      const std::lock_guard<std::mutex> lock(arena.mutex_);
      arena.is_working_ = true;
    }
    arena.changed_.notify_all();
  }
  ~Working() {
    const std::lock_guard<std::mutex> lock(arena_.mutex_);
    arena_.is_working_ = false;
    for (Stay* const stay : arena_.stays_) stay->graph.release_wait();
    arena_.stays_.clear();
  }
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

 private:
  WorkArena& arena_;
};

WorkArena::WorkArena() : WorkArena(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2)) {}

/// All of its slots are reserved for threads that enter by themselves, so that TBB sends none of its own.
WorkArena::WorkArena(int threads)
    : threads_(static_cast<std::size_t>(threads)), arena_(threads, static_cast<unsigned>(threads)) {}

WorkArena::~WorkArena() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void WorkArena::run(const std::function<void()>& work) {
  const CancelPoint cancel;
  while (!turn_.try_lock_for(std::chrono::milliseconds(20))) cancel.check();
  const std::lock_guard<std::timed_mutex> turn(turn_, std::adopt_lock);
  while (helpers_.size() + 1 < threads_) helpers_.emplace_back([this] { help(); });
  const Working working(*this);
  arena_.execute(work);
}

void WorkArena::help() {
  lowerPriority();
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return is_working_ || is_stopping_; });
    if (is_stopping_) return;
    lock.unlock();
    arena_.execute([this] {
      Stay stay;
      if (enter(stay)) stay.graph.wait_for_all();
      const std::lock_guard<std::mutex> released(mutex_);  // only then may the stay end
    });
    lock.lock();
  }
}

/// @return whether there is still work.
bool WorkArena::enter(Stay& stay) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!is_working_) return false;
  stay.graph.reserve_wait();
  stays_.push_back(&stay);
  return true;
}

}  // namespace sdf_ccd
