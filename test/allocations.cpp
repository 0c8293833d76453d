#include "allocations.h"

#include <malloc.h>

#include <cstdlib>
#include <new>

namespace sdf_ccd::test {

std::atomic<long> held{0}, most_held{0};

void hold(long bytes) {
  const long now = held += bytes;
  for (long most = most_held; now > most && !most_held.compare_exchange_weak(most, now);) {
  }
}

}  // namespace sdf_ccd::test

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* const memory = std::malloc(size ? size : 1);
  if (memory) sdf_ccd::test::hold(static_cast<long>(malloc_usable_size(memory)));
  return memory;
}
void* operator new(std::size_t size) {
  void* const memory = operator new(size, std::nothrow);
  if (!memory) throw std::bad_alloc();
  return memory;
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto side = static_cast<std::size_t>(alignment);
  void* const memory = std::aligned_alloc(side, (size + side - 1) / side * side);
  if (!memory) throw std::bad_alloc();
  sdf_ccd::test::hold(static_cast<long>(malloc_usable_size(memory)));
  return memory;
}
void operator delete(void* memory) noexcept {
  sdf_ccd::test::hold(-static_cast<long>(malloc_usable_size(memory)));
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  operator delete(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  operator delete(memory);
}
