#include "thread_allocations.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define SDF_CCD_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SDF_CCD_SANITIZED
#endif

namespace sdf_ccd::test {

std::atomic<pid_t> counted_thread{0};  // 0: none
std::atomic<long> counted_allocations{0};

pid_t threadId() {
  thread_local const auto id = static_cast<pid_t>(syscall(SYS_gettid));
  return id;
}

void countAllocation() {
  const pid_t counted = counted_thread.load(std::memory_order_relaxed);
  if (counted != 0 && counted == threadId()) counted_allocations.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace sdf_ccd::test

#ifndef SDF_CCD_SANITIZED
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  sdf_ccd::test::countAllocation();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  sdf_ccd::test::countAllocation();
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  sdf_ccd::test::countAllocation();
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  sdf_ccd::test::countAllocation();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  *memory = memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}
#endif
