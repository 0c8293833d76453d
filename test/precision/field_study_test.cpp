#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/shapes.h"
#include "precision/studies.h"

namespace sdf_ccd::precision::field_study_test {

/// Queries in batches are the single ones, many at once: their errors are the same up to single precision.
TEST(FieldStudy, BatchesFindTheSameHits) {
  StudyInput input;
  input.mesh = test::torusMesh(0.07, 0.03, 24, 12);
  input.queries = 300;
  input.quick = true;
  const StudyResult result = maxErrorStudy(input);
  int compared = 0;
  for (const Measurement& row : result.rows) {
    if (row.system.rfind("sdf_ccd batch", 0) != 0) continue;
    const auto single = std::find_if(result.rows.begin(), result.rows.end(), [&](const Measurement& other) {
      return other.quantity == row.quantity && other.setting == row.setting && other.system.rfind("sdf_ccd (", 0) == 0;
    });
    ASSERT_NE(single, result.rows.end());
    EXPECT_NEAR(row.error.median, single->error.median, 1e-6);
    EXPECT_NEAR(row.error.max, single->error.max, 1e-6);
    EXPECT_EQ(row.missed, single->missed);
    ++compared;
  }
  EXPECT_GT(compared, 1);
}

}  // namespace sdf_ccd::precision::field_study_test
