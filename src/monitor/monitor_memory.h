#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "pair_cycle.h"

namespace sdf_ccd {

/// Scratch memory, taken for a few pairs and given back, so that there is one per thread that checks pairs at the same
/// time. The last one given back is taken first.
struct MonitorMemory {
  std::unique_ptr<PairMemory> acquire() {
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

}  // namespace sdf_ccd
