#include <stdexcept>

#include <gtest/gtest.h>

#include "allocations.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::adaptive_memory_test {

constexpr long kConstant = 3 << 20;  // search structures, and the cells at which the threads are

/// Peak of the additional memory while a field is built, or refused [bytes].
template <typename Build>
long peakOf(const Build& build) {
  const long before = test::held;
  test::most_held = before;
  build();
  return test::most_held - before;
}

TEST(AdaptiveMemory, ARefusedFieldTakesNoMoreThanTwiceTheLimit) {
  const TriangleMesh mesh = test::icosphere(0.3, 2);
  FieldOptions options;
  options.max_error = 3e-7;
  options.max_bytes = 4 << 20;
  const long peak = peakOf([&] { EXPECT_THROW(buildField(mesh, options), std::length_error); });
  EXPECT_LT(peak, 2 * long(options.max_bytes) + kConstant);
  EXPECT_GT(peak, long(options.max_bytes) / 2) << "the limit is used";
}

TEST(AdaptiveMemory, BuildingTakesNoMoreThanTwoAndAHalfTimesTheField) {
  const TriangleMesh mesh = test::icosphere(0.3, 2);
  FieldOptions options;
  options.max_error = 2e-5;
  long bytes = 0;
  const long peak = peakOf([&] { bytes = long(buildField(mesh, options).bytes()); });
  EXPECT_GT(bytes, 1 << 20);
  EXPECT_LT(peak, 5 * bytes / 2 + kConstant);
}

}  // namespace sdf_ccd::adaptive_memory_test
