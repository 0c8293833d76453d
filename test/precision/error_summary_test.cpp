#include "precision/error_summary.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace sdf_ccd::precision::error_summary_test {

TEST(ErrorSummary, OfOneHundredNumbers) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const ErrorSummary summary = summarize(values);
  EXPECT_EQ(summary.median, 50.0);
  EXPECT_EQ(summary.p99, 99.0);
  EXPECT_EQ(summary.max, 100.0);
  EXPECT_EQ(summary.count, 100u);
}

TEST(ErrorSummary, OfOneNumberIsThatNumber) {
  const ErrorSummary summary = summarize({3.0});
  EXPECT_EQ(summary.median, 3.0);
  EXPECT_EQ(summary.p99, 3.0);
  EXPECT_EQ(summary.max, 3.0);
}

TEST(ErrorSummary, OfNothingThrows) {
  EXPECT_THROW(summarize({}), std::invalid_argument);
}

TEST(ErrorSummary, QuantilesAreValuesThatWereThere) {
  std::vector<double> values{4.0, 1.0, 2.0, 3.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.25), 1.0);
  EXPECT_EQ(quantile(values, 0.26), 2.0);
  EXPECT_EQ(quantile(values, 0.75), 3.0);
  EXPECT_EQ(quantile(values, 1.0), 4.0);
}

}  // namespace sdf_ccd::precision::error_summary_test
