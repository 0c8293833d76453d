#pragma once

#include <tbb/global_control.h>

#include <atomic>

#include "thread_allocations.h"

/// The memory that a test program holds through operator new; links test_allocations.
namespace sdf_ccd::test {

extern std::atomic<long> held, most_held;

/// Allocations of the last of several equal rounds, on one thread: a thread that joins late makes its own scratch
/// memory once, whenever that is.
template <typename Round>
long steadyAllocations(const Round& round) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  for (int i = 0; i < 3; ++i) round();
  const ThreadAllocations allocations;
  round();
  return allocations.count();
}

}  // namespace sdf_ccd::test
