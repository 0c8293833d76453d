#include "monitor/summarise.h"

#include <gtest/gtest.h>

namespace sdf_ccd {
namespace {

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

}  // namespace
}  // namespace sdf_ccd
