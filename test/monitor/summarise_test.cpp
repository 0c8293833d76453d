#include "monitor/summarise.h"

#include <gtest/gtest.h>

namespace sdf_ccd::summarise_test {

TEST(Summarise, ListsPairsThatAreNeitherClearNorDelayed) {
  CycleResult result;
  for (const Verdict verdict : {Verdict::kContact, Verdict::kClear, Verdict::kNotChecked, Verdict::kUncertain}) {
    for (const WaypointSpan& span : {WaypointSpan{0, 0}, {0, 1}}) {
      PairResult& pair = result.pairs.emplace_back();
      pair.verdict = verdict;
      pair.span = span;
    }
  }
  result.not_clear = {3};
  summarise(result);
  EXPECT_EQ(result.not_clear, (std::vector<int>{1, 5, 7}));
  CycleSummary in_any_order(result, 1);
  for (const int pair : {7, 4, 1, 5}) in_any_order.add(pair);
  in_any_order.finish();
  EXPECT_EQ(result.not_clear, (std::vector<int>{1, 5, 7}));
  addUnchecked({{0, 1, "why"}}, result);
  EXPECT_EQ(result.not_clear, (std::vector<int>{1, 5, 7, 8}));
}

TEST(Summarise, WhatIsUncheckedIsNotClear) {
  CycleResult result;
  result.verdict = Verdict::kClear;
  addUnchecked({}, result);
  EXPECT_EQ(result.verdict, Verdict::kClear);
  addUnchecked({{0, 1, "why"}}, result);
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_EQ(result.not_checked, 1);
  ASSERT_EQ(result.pairs.size(), 1u);
  EXPECT_EQ(result.pairs[0].verdict, Verdict::kNotChecked);
  EXPECT_EQ(result.pairs[0].reason, "why");
  result.verdict = Verdict::kContact;
  addUnchecked({{0, 1, "why"}}, result);
  EXPECT_EQ(result.verdict, Verdict::kContact);
}

}  // namespace sdf_ccd::summarise_test
