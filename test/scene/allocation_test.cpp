#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "scene/scene_case.h"

namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace sdf_ccd {
namespace {

using namespace test;

/// Allocations of the last of several equal rounds, on one thread: a thread that joins late makes its own scratch
/// memory once, whenever that is.
template <typename Round>
long steadyAllocations(const Round& round) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  for (int i = 0; i < 3; ++i) round();
  const long before = allocations;
  round();
  return allocations - before;
}

TEST(Allocation, NoneWhilePairsAreClear) {
  const auto scene = build({body("ground", ground(), true), body("a", Primitive(Sphere{0.1})),
                            body("b", Primitive(Box{{0.1, 0.1, 0.1}})), body("c", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, {});
  std::vector<CycleMotion> motions;
  for (int i = 0; i < 20; ++i) {
    // Two just above the error bound, so that they are tested every time, one far away.
    const double x = 0.001 * i;
    motions.push_back(cycle(0.1, {still(Isometry3d::Identity()),
                                  {translation({x, 0, 0.115}), translation({x + 1e-3, 0, 0.115})},
                                  still(translation({-0.214, 0, 0.215})),
                                  still(translation({0, 3, 5}))}));
  }
  int tested = 0;
  EXPECT_EQ(steadyAllocations([&] {
              for (const CycleMotion& motion : motions) {
                const CycleResult& result = monitor.run(motion, {});
                tested += result.checked;
                ASSERT_EQ(result.verdict, Verdict::kClear);
              }
            }),
            0);
  EXPECT_GT(tested, 20);
}

TEST(Allocation, NoneForAContactLikeTheLast) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1})),
                            body("box", Primitive(Box{{0.1, 0.1, 0.1}}))});
  Monitor monitor(scene, {});
  const CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()),
                                         still(translation({0, 0, 0.095})),
                                         {translation({0.19, 0, 0.1}), translation({0.19, 0, 0.12})}});
  EXPECT_EQ(steadyAllocations([&] { ASSERT_EQ(monitor.run(motion, {true, 10}).verdict, Verdict::kContact); }), 0);
}

}  // namespace
}  // namespace sdf_ccd
