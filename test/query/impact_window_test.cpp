#include "query/least_distance.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::impact_window_test {

using test::Random;

const Vector3d kHalf(0.1, 0.075, 0.05);
const DistanceField kBox{Primitive(Box::fromSize(2.0 * kHalf))};

std::optional<double> firstContact(const Segment& segment) {
  const Intervals found = segmentIntervals(kBox, segment, {0.0, SegmentMode::kFirst});
  return found.empty() ? std::optional<double>() : found.front().enter;
}

/// Compares the windows of a box's sampled field with the times of impact by its exact distance.
/// @return the median length of the windows that have a latest time, in multiples of the field's error bound.
double expectHonest(const FieldOptions& options) {
  const DistanceField field = buildField(test::boxMesh(kHalf), options);
  Random random(4);
  std::vector<double> lengths;
  int met = 0, missed = 0;
  for (int i = 0; i < 6000 && !testing::Test::HasFailure(); ++i) {
    const AlignedBox3d around{-3.0 * kHalf, 3.0 * kHalf};
    Segment segment{test::uniformIn(random, around), test::uniformIn(random, around)};
    if (i % 3 == 1) segment.end = segment.start + 0.02 * test::direction(random);
    // Along a face, up to a few errors beside it.
    if (i % 3 == 2) segment.start.z() = segment.end.z() = kHalf.z() + 0.005 * (test::uniform(random, -1.0, 1.0));
    const double length = (segment.end - segment.start).norm();
    const std::optional<double> exact = firstContact(segment);
    const std::optional<ImpactWindow> window = impactWindow(field, segment);
    if (!exact) {
      ++missed;
      EXPECT_TRUE(!window || !window->latest) << "surely met: " << i;
      continue;
    }
    ++met;
    EXPECT_TRUE(window) << "surely not met: " << i;
    if (!window) break;
    EXPECT_LE(window->earliest, *exact + 2e-9) << i;
    if (window->time) {
      EXPECT_LE(window->earliest, *window->time) << i;
    }
    if (!window->latest) continue;
    EXPECT_GE(*window->latest, *exact - 2e-9) << i;
    lengths.push_back(length * (*window->latest - window->earliest) / field.errorBound());
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(missed, 1000);
  EXPECT_GT(lengths.size(), 1000U);
  std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
  return lengths[lengths.size() / 2];
}

TEST(ImpactWindow, HoldsTheContactOfUniformFields) {
  FieldOptions options;
  options.cells = 32;
  EXPECT_LT(expectHonest(options), 0.2);
}

TEST(ImpactWindow, HoldsTheContactOfAdaptiveFields) {
  FieldOptions options;
  options.max_error = 0.001;
  EXPECT_LT(expectHonest(options), 1.5);
}

TEST(ImpactWindow, OfAnExactFieldIsAPoint) {
  const Segment into{{0.3, 0.01, 0.02}, {-0.1, 0.01, 0.02}};
  const std::optional<ImpactWindow> window = impactWindow(kBox, into);
  ASSERT_TRUE(window && window->time && window->latest);
  EXPECT_NEAR(window->earliest, 0.5, 1e-9);
  EXPECT_NEAR(*window->latest, 0.5, 1e-9);
  EXPECT_FALSE(impactWindow(kBox, {{0.3, 0.01, 0.02}, {0.11, 0.01, 0.02}}));
}

TEST(ImpactWindow, OfAPointThatRestsInsideIsItsStart) {
  FieldOptions options;
  options.cells = 32;
  const DistanceField field = buildField(test::boxMesh(kHalf), options);
  const std::optional<ImpactWindow> window = impactWindow(field, {Vector3d(0, 0, 0.03), Vector3d(0, 0, 0.03)});
  ASSERT_TRUE(window && window->latest);
  EXPECT_EQ(window->earliest, 0.0);
  EXPECT_EQ(*window->latest, 0.0);
}

}  // namespace sdf_ccd::impact_window_test
