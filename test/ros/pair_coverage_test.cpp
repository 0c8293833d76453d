#include "ros/bag/pair_coverage.h"

#include <gtest/gtest.h>

namespace sdf_ccd::pair_coverage_test {

TEST(PairCoverage, NamesPairsThatWereNotRightlyLeftOut) {
  TrackedCycle cycle;
  cycle.motion.times = {0.0, 0.5};
  CycleResult result;
  result.pairs.resize(1);
  result.pairs[0].verdict = Verdict::kClear;
  result.pairs[0].span = {0, 1};
  PairCoverage coverage;
  const auto add = [&](double start, const std::vector<std::pair<int, int>>& doubtful) {
    cycle.start = cycle.origin = ros::Time(start);
    cycle.end = ros::Time(start + 0.5);
    result.pairs.resize(1);
    for (const auto& [a, b] : doubtful) {
      result.pairs.emplace_back();
      result.pairs.back().body_a = a;
      result.pairs.back().body_b = b;
    }
    coverage.add(cycle, result, 1);
  };
  add(10.0, {});
  add(10.5, {{0, 2}, {1, 2}});
  add(11.0, {{1, 2}});
  EXPECT_DOUBLE_EQ(coverage.total(), 1.5);
  EXPECT_EQ(coverage.neverChecked(), 0u);
  EXPECT_EQ(coverage.partlyChecked(0.1).pairs, 0u);
  ASSERT_EQ(coverage.doubtful(0.1).size(), 2u);
  EXPECT_EQ(coverage.doubtful(0.1)[0].body_a, 1);
  EXPECT_DOUBLE_EQ(coverage.doubtful(0.1)[0].seconds, 1.0);
  EXPECT_EQ(coverage.doubtful(0.6).size(), 1u);
}

}  // namespace sdf_ccd::pair_coverage_test
