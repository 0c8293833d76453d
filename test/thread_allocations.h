#pragma once

#include <sys/types.h>

#include <atomic>

/// Counts what one thread of a test program allocates, through operator new or as Eigen and TBB do; links
/// test_allocations, which replaces malloc. Sanitizers have a malloc of their own; under them nothing is counted.
namespace sdf_ccd::test {

extern std::atomic<pid_t> counted_thread;  // 0: none
extern std::atomic<long> counted_allocations;

pid_t threadId();

/// The allocations of a thread while this exists, which is once at a time.
class ThreadAllocations {
 public:
  explicit ThreadAllocations(pid_t thread = threadId()) : before_(counted_allocations) { counted_thread = thread; }
  ~ThreadAllocations() { counted_thread = 0; }
  ThreadAllocations(const ThreadAllocations&) = delete;
  ThreadAllocations& operator=(const ThreadAllocations&) = delete;

  long count() const { return counted_allocations - before_; }

 private:
  const long before_;
};

}  // namespace sdf_ccd::test
