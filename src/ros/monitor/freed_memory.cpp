#include "ros/monitor/freed_memory.h"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>

namespace sdf_ccd {
namespace {

/// Allocates the free end of the heap in blocks of decreasing size, and gives their pages back before it frees them.
/// malloc_trim() does not touch it.
void returnEndOfHeap() {
  constexpr std::array<std::size_t, 9> kSizes{
      16 << 20,  8 << 20,   4 << 20,   2 << 20, 1 << 20,
      512 << 10, 256 << 10, 128 << 10, 64 << 10};  // below what is always mapped
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  std::array<void*, kSizes.size()> blocks{};
  for (std::size_t i = 0; i < kSizes.size(); ++i) {
    blocks[i] = std::malloc(kSizes[i]);
    if (blocks[i] == nullptr) break;
    auto* const block = static_cast<char*>(blocks[i]);
    const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(block) % page) % page;
    madvise(block + before, (kSizes[i] - before) / page * page, MADV_DONTNEED);
  }
  for (void* block : blocks) std::free(block);
}

}  // namespace

void returnFreedMemory() {
  returnEndOfHeap();
  malloc_trim(0);
}

}  // namespace sdf_ccd
