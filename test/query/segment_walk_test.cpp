#include "sdf_ccd/segments.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "oracle/random_segment.h"
#include "oracle/sampled_function.h"
#include "oracle/shapes.h"
#include "oracle/uniform_walk.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::segment_walk_test {

using test::Random;
using test::randomSegment;
using test::UniformWalk;

/// Segments per field; SDF_CCD_SEGMENTS sets another number, e.g. a million.
int segmentCount() {
  const char* wanted = std::getenv("SDF_CCD_SEGMENTS");
  return wanted ? std::atoi(wanted) : 20000;
}

/// Counts what was compared, so that the test cannot pass on segments that meet nothing.
struct Agreement {
  long spans = 0;
  long double_crossings = 0;  ///< spans that follow another within two cells
  long grazing = 0;           ///< spans less than a thousandth of a cell deep
};

/// Every span of the oracle that is deeper than rounding must be found, with its ends, and nothing else.
void expectAgreement(const DistanceField& field, const Segment& segment, double sigma, Agreement& agreement) {
  // A crossing of a face is known to the rounding of coordinates; on a short segment that is a large part of its time.
  const double place_time =
      1e-15 * test::latticeOf(field).box().sizes().maxCoeff() / std::max((segment.end - segment.start).norm(), 1e-300);
  const double tick = std::max(1e-12, 4.0 * place_time), time = std::max(1e-9, 4.0 * place_time);
  constexpr long double kRounding = 1e-13L;
  const UniformWalk walk(field, segment, sigma);
  const Intervals fast = segmentIntervals(field, segment, {sigma});
  for (std::size_t i = 0; i < fast.size(); ++i) {
    ASSERT_LE(0.0, fast[i].enter);
    ASSERT_LE(fast[i].enter, fast[i].exit);
    ASSERT_LE(fast[i].exit, 1.0);
    if (i > 0) {
      ASSERT_LT(fast[i - 1].exit, fast[i].enter);
    }
    for (const double end : {fast[i].enter, fast[i].exit}) {
      // An end on the grid's boundary may lie outside by rounding.
      const long double lowest = std::min({walk.value(end), walk.value(end - tick), walk.value(end + tick)});
      ASSERT_LE(lowest, 1e-9) << "not inside at " << end << " of " << fast[i].enter << ".." << fast[i].exit << ", from "
                              << segment.start.transpose() << " to " << segment.end.transpose() << ", sigma " << sigma;
    }
  }
  const auto sameTime = [&](double fast_time, long double slow_time) {
    if (std::abs(fast_time - double(slow_time)) <= time) return true;
    // Grazing: the time is only as good as the value allows.
    return std::abs(walk.value(fast_time)) <= kRounding;
  };
  const double cell_time = test::latticeOf(field).cell / std::max((segment.end - segment.start).norm(), 1e-12);
  long double last_exit = -1.0L;
  for (const UniformWalk::Span& span : walk.spans()) {
    if (span.lowest > -kRounding) continue;
    ++agreement.spans;
    agreement.double_crossings += last_exit >= 0.0L && span.enter - last_exit < 2 * cell_time;
    agreement.grazing += span.lowest > -1e-3L * test::latticeOf(field).cell;
    last_exit = span.exit;
    bool matched = false;
    for (const Interval& interval : fast) {
      if (interval.enter > span.exit + time || interval.exit < span.enter - time) continue;
      // Spans that nearly touch may be merged in the other result.
      matched = (sameTime(interval.enter, span.enter) || interval.enter < span.enter) &&
                (sameTime(interval.exit, span.exit) || interval.exit > span.exit);
      if (matched) break;
    }
    ASSERT_TRUE(matched) << "lost [" << double(span.enter) << ", " << double(span.exit) << "] " << double(span.lowest)
                         << " m deep, from " << segment.start.transpose() << " to " << segment.end.transpose()
                         << ", sigma " << sigma;
  }
  // Between two intervals of the fast query the point is outside.
  for (std::size_t i = 1; i < fast.size(); ++i) {
    const double middle = 0.5 * (fast[i - 1].exit + fast[i].enter);
    if (fast[i].enter - fast[i - 1].exit > time) {
      ASSERT_GE(walk.value(middle), -kRounding);
    }
  }
}

void compareRandom(const DistanceField& field, std::uint64_t seed, Agreement& agreement) {
  Random random(seed);
  const int n = segmentCount();
  for (int i = 0; i < n; ++i) {
    const double sigma = i % 3 == 0 ? 0.0 : test::uniform(random, -field.band(), field.band());
    expectAgreement(field, randomSegment(field, random, i), sigma, agreement);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(SegmentQuery, EqualsUniformWalkOnTorus) {
  FieldOptions options;
  options.cells = 48;
  Agreement agreement;
  compareRandom(buildField(test::torusMesh(0.2, 0.08, 48, 24), options), 1, agreement);
  EXPECT_GT(agreement.spans, segmentCount() / 20);
}

TEST(SegmentQuery, EqualsUniformWalkOnThinPlate) {
  FieldOptions options;
  options.cells = 40;
  Agreement agreement;
  // The plate is a fifth of a cell thick: the interpolated field has bumps and holes, and many double crossings.
  compareRandom(buildField(test::boxMesh({0.2, 0.15, 0.001}), options), 2, agreement);
  EXPECT_GT(agreement.spans, segmentCount() / 100);
}

/// Leaves of all sizes, with jumps between them: along a face between leaves the result is ambiguous, so no segment
/// here runs in a face.
void compareAdaptive(const TriangleMesh& mesh, double max_error, Agreement& agreement) {
  FieldOptions options;
  options.max_error = max_error;
  options.band = 3.0 * max_error;
  const DistanceField field = buildField(mesh, options);
  Random random(11);
  for (int i = 0; i < segmentCount() / 10; ++i) {
    const int kind = i % 8 == 4 || i % 8 == 6 ? 0 : i;
    const double sigma = i % 3 == 0 ? 0.0 : test::uniform(random, -field.band(), field.band());
    expectAgreement(field, randomSegment(field, random, kind), sigma, agreement);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(SegmentQuery, EqualsUniformWalkOnAdaptiveTorus) {
  Agreement agreement;
  compareAdaptive(test::torusMesh(0.2, 0.08, 48, 24), 0.004, agreement);
  EXPECT_GT(agreement.spans, segmentCount() / 200);
}

TEST(SegmentQuery, EqualsUniformWalkOnAdaptivePlate) {
  Agreement agreement;
  compareAdaptive(test::boxMesh({0.2, 0.15, 0.001}), 0.006, agreement);
  EXPECT_GT(agreement.spans, segmentCount() / 1000);
}

TEST(SegmentQuery, EqualsUniformWalkOnNoise) {
  const auto noise = [](const Vector3d& p) {
    if (std::max({std::abs(p.x()), 0.5 * std::abs(p.y()), std::abs(p.z())}) > 0.0799) return 0.005;  // as far outside
    Random random(std::uint64_t(std::llround(p.x() * 100) * 1000003 + std::llround(p.y() * 100) * 1009 +
                                std::llround(p.z() * 100)));
    return test::uniform(random, -0.005, 0.005);
  };
  const auto field = test::sampledFunction(noise, {2, 4, 2}, 0.01, 0.0025);
  Agreement agreement;
  compareRandom(field, 4, agreement);
  EXPECT_GT(agreement.double_crossings, segmentCount() / 4);
  EXPECT_GT(agreement.spans, segmentCount());
}

TEST(SegmentQuery, EqualsUniformWalkWhenGrazing) {
  // Segments at the height of a wave's crests, which just reach the isosurface.
  constexpr double kSlope = 0.6;
  const auto field = test::sampledFunction(
      [](const Vector3d& p) { return kSlope * (0.02 * std::sin(60 * p.x()) * std::sin(50 * p.y()) + p.z()); },
      {3, 3, 2}, 0.01, 0.03);
  Random random(5);
  Agreement agreement;
  for (int i = 0; i < segmentCount(); ++i) {
    const AlignedBox3d box = test::latticeOf(field).box();
    Segment s{test::uniformIn(random, box), test::uniformIn(random, box)};
    // Start and end at the height at which a crest is just touched.
    const double height = field.sample(s.start).value / kSlope - s.start.z();
    s.start.z() = s.end.z() = -height + test::uniform(random, -1e-6, 1e-6);
    expectAgreement(field, s, 0.0, agreement);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(agreement.spans, segmentCount() / 2);
  EXPECT_GT(agreement.grazing, segmentCount() / 100);
}

TEST(SegmentQuery, PaperSignTestLosesThisDoubleCrossing) {
  // Both ends of the segment's piece in the cell are outside, its middle is inside.
  const auto field = test::sampledFunction(
      [](const Vector3d& p) { return std::abs(p.x()) < 1e-9 && std::abs(p.y()) < 1e-9 ? 0.01 : -0.01; }, {1, 1, 1}, 0.1,
      0.05);
  const Segment s{{-0.02, 0.0, 0.0}, {0.05, -0.05, 0.0}};
  Agreement agreement;
  expectAgreement(field, s, 0.0, agreement);
  EXPECT_GE(agreement.spans, 1);
}

}  // namespace sdf_ccd::segment_walk_test
