// The worst of several verdicts, whatever their numbers are; and that a zeroed one says nothing good.

#include "query/worst_verdict.h"
#include "sdf_ccd/result.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sdf_ccd::verdict_test {

const std::vector<Verdict> kBySeverity = {Verdict::kClear, Verdict::kNotChecked, Verdict::kUncertain,
                                          Verdict::kContact};

Verdict worstOf(const std::vector<Verdict>& verdicts) {
  WorstVerdict worst;
  for (const Verdict verdict : verdicts) worst.add(verdict);
  return worst.value();
}

TEST(Verdict, IsNotCheckedWhenItIsZeroed) {
  EXPECT_EQ(Verdict{}, Verdict::kNotChecked);
  EXPECT_EQ(static_cast<Verdict>(0), Verdict::kNotChecked);
}

TEST(Verdict, WorstOfNothingIsNotChecked) {
  EXPECT_EQ(worstOf({}), Verdict::kNotChecked);
  EXPECT_EQ(worstOf({Verdict::kClear}), Verdict::kClear);
}

TEST(Verdict, WorstIsTheMostSevereInAnyOrder) {
  for (int set = 1; set < 16; ++set) {
    std::vector<Verdict> verdicts;
    for (int i = 0; i < 4; ++i) {
      if (set & (1 << i)) verdicts.push_back(kBySeverity[i]);
    }
    const Verdict worst = verdicts.back();
    std::vector<int> order(verdicts.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    do {
      std::vector<Verdict> permuted;
      for (const int i : order) permuted.push_back(verdicts[i]);
      EXPECT_EQ(worstOf(permuted), worst) << set;
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(Verdict, SeverityIsAStrictOrder) {
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < 4; ++b) EXPECT_EQ(isWorse(kBySeverity[a], kBySeverity[b]), a > b) << a << " " << b;
}

TEST(Verdict, MayTouchUnlessItIsClearOrUnknown) {
  for (const Verdict verdict : kBySeverity)
    EXPECT_EQ(mayTouch(verdict), verdict == Verdict::kUncertain || verdict == Verdict::kContact) << toString(verdict);
}

}  // namespace sdf_ccd::verdict_test
