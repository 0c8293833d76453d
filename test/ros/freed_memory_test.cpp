#include "ros/monitor/freed_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <thread>
#include <vector>

namespace sdf_ccd::freed_memory_test {

constexpr double kMegabyte = 1e6;

double residentMegabytes() {
  std::ifstream file("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / kMegabyte;
}

/// Allocates `megabytes` in small blocks and frees them.
void useMemory(std::size_t megabytes) {
  constexpr std::size_t kBlock = 500;
  std::vector<std::vector<char>> blocks;
  for (std::size_t i = 0; i < megabytes * 1000000 / kBlock; ++i) blocks.emplace_back(kBlock, 'x');
}

TEST(FreedMemory, TheEndOfAThreadsHeapIsReturned) {
  // glibc keeps twice as much at the end of heaps as the largest block freed so far.
  ASSERT_EQ(0, std::vector<char>(std::size_t{24} << 20).back());
  double used = 0.0, kept = 0.0;
  std::thread([&] {
    const double before = residentMegabytes();
    useMemory(20);
    used = residentMegabytes() - before;
    returnFreedMemory();
    kept = residentMegabytes() - before;
  }).join();
  EXPECT_GT(used, 10.0);
  EXPECT_LT(kept, 2.0);
}

}  // namespace sdf_ccd::freed_memory_test
