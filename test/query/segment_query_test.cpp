#include "sdf_ccd/segments.h"

#include <gtest/gtest.h>

#include "oracle/box_union.h"
#include "oracle/random_segment.h"
#include "oracle/sampled_function.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::segment_query_test {

using test::Random;
using test::randomSegment;

TEST(SegmentQuery, SphereHasClosedForm) {
  const DistanceField sphere{Primitive(Sphere{0.5})};
  const Intervals hit = segmentIntervals(sphere, {{-1, 0.3, 0}, {1, 0.3, 0}});
  ASSERT_EQ(hit.size(), 1U);
  EXPECT_NEAR(hit[0].enter, 0.5 - 0.2, 1e-14);
  EXPECT_NEAR(hit[0].exit, 0.5 + 0.2, 1e-14);
  const Intervals wider = segmentIntervals(sphere, {{-1, 0, 0}, {1, 0, 0}}, {0.25});
  ASSERT_EQ(wider.size(), 1U);
  EXPECT_NEAR(wider[0].enter, 0.125, 1e-14);
  EXPECT_TRUE(segmentIntervals(sphere, {{-1, 0.5001, 0}, {1, 0.5001, 0}}).empty());
}

TEST(SegmentQuery, GrazingSegmentGivesOneInterval) {
  const DistanceField sphere{Primitive(Sphere{0.5})};
  const Intervals hit = segmentIntervals(sphere, {{-1, 0.5, 0}, {1, 0.5, 0}});
  ASSERT_EQ(hit.size(), 1U);
  EXPECT_NEAR(hit[0].enter, 0.5, 1e-6);
  EXPECT_LE(hit[0].exit - hit[0].enter, 1e-6);
}

TEST(SegmentQuery, PrimitivesEqualDenseSampling) {
  Random random(6);
  const std::vector<Primitive> solids{Sphere{0.3}, Box::fromSize({0.2, 0.6, 0.4}),
                                      Cylinder::fromRadiusAndLength(0.2, 0.6),
                                      HalfSpace{Vector3d(1, 2, -1).normalized(), 0.1}};
  int found = 0;
  for (int i = 0; i < 4000; ++i) {
    const DistanceField field{solids[i % 4]};
    const AlignedBox3d box{Vector3d::Constant(-0.7), Vector3d::Constant(0.7)};
    const Segment s{test::uniformIn(random, box), test::uniformIn(random, box)};
    const double sigma = i % 2 ? 0.0 : test::uniform(random, -0.05, 0.3);
    const Intervals hit = segmentIntervals(field, s, {sigma});
    ASSERT_LE(hit.size(), 1U);  // convex
    found += !hit.empty();
    const auto value = [&](double t) { return field.sample(s.start + t * (s.end - s.start)).value - sigma; };
    for (int k = 0; k <= 200; ++k) {
      const double t = k / 200.0;
      const bool inside = !hit.empty() && hit[0].enter <= t && t <= hit[0].exit;
      if (std::abs(value(t)) > 1e-12) {
        ASSERT_EQ(inside, value(t) <= 0.0) << "t " << t;
      }
    }
    if (!hit.empty() && hit[0].enter > 0) {
      ASSERT_NEAR(value(hit[0].enter), 0.0, 1e-12);
    }
    if (!hit.empty() && hit[0].exit < 1) {
      ASSERT_NEAR(value(hit[0].exit), 0.0, 1e-12);
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(SegmentQuery, ReversedInTimeGivesTheMirroredIntervals) {
  FieldOptions options;
  options.cells = 32;
  const DistanceField field = buildField(test::torusMesh(0.2, 0.08, 32, 16), options);
  Random random(7);
  for (int i = 0; i < 5000; ++i) {
    const Segment s = randomSegment(field, random, 0);
    const Intervals forward = segmentIntervals(field, s), back = segmentIntervals(field, {s.end, s.start});
    ASSERT_EQ(forward.size(), back.size());
    for (std::size_t k = 0; k < forward.size(); ++k) {
      EXPECT_NEAR(forward[k].enter, 1.0 - back[back.size() - 1 - k].exit, 1e-9);
      EXPECT_NEAR(forward[k].exit, 1.0 - back[back.size() - 1 - k].enter, 1e-9);
    }
  }
}

using Vector3r = Eigen::Matrix<long double, 3, 1>;

/// Distance from a root to the point of the segment where φ changes its sign, in long double, times φ's slope there
/// [m]. Negative if the slope is less than a third or no single change of sign is found.
double rootError(const DistanceField& field, const Segment& segment, double t) {
  const Vector3r start = segment.start.cast<long double>(), path = segment.end.cast<long double>() - start;
  const long double length = path.norm();
  const auto value = [&](long double metres) {
    const Vector3r p = start + (t + metres / length) * path;
    return field.sample(p.cast<double>()).value;
  };
  for (long double step = 1e-16L; step < 0.03L; step *= 2) {
    long double low = -step, high = step;
    if ((value(low) > 0) == (value(high) > 0)) continue;
    // At most 1: where cells of different size meet, the interpolant may jump.
    const double slope = std::min(1.0, std::abs(value(1e-6L) - value(-1e-6L)) / 2e-6);
    if (slope < 0.33) return -1.0;
    for (int k = 0; k < 60; ++k) {
      const long double middle = 0.5L * (low + high);
      ((value(middle) > 0) == (value(low) > 0) ? low : high) = middle;
    }
    return static_cast<double>(std::abs(low)) * slope;
  }
  return -1.0;
}

/// Segments of one length through random points near the origin.
std::vector<Segment> longSegments(double length, int count) {
  Random random(15);
  std::vector<Segment> segments;
  for (int i = 0; i < count; ++i) {
    const Vector3d way = length * test::direction(random);
    const Vector3d p = test::uniformIn(random, {Vector3d::Constant(-0.2), Vector3d::Constant(0.2)});
    const double before = i % 4 ? test::uniform(random, 0, 1) : i % 8 ? 1e-6 : 1.0 - 1e-6;
    segments.push_back({p - before * way, p + (1.0 - before) * way});
    if (!isWithinReach(segments.back())) segments.pop_back();
  }
  return segments;
}

std::vector<DistanceField> fieldsOfAllKinds() {
  FieldOptions even, adaptive;
  even.cells = 32;
  adaptive.max_error = 1e-3;
  const TriangleMesh torus = test::torusMesh(0.2, 0.08, 32, 16);
  return {DistanceField{Primitive(Sphere{0.3})}, DistanceField{Primitive(Box::fromSize({0.2, 0.6, 0.4}))},
          DistanceField{Primitive(Cylinder::fromRadiusAndLength(0.2, 0.6))}, buildField(torus, even),
          buildField(torus, adaptive)};
}

/// The documented accuracy holds and is not too pessimistic.
TEST(SegmentQuery, RootsAreRightToAFewSpacingsOfDoublesAtTheirCoordinates) {
  for (const DistanceField& field : fieldsOfAllKinds()) {
    double most = 0.0;
    int roots = 0;
    for (const double length : {1.0, 1e4, 1e8, 1e12}) {
      for (const Segment& s : longSegments(length, 1000)) {
        const double coordinate = std::max({s.start.lpNorm<Eigen::Infinity>(), s.end.lpNorm<Eigen::Infinity>(), 0.5});
        for (const Interval& interval : segmentIntervals(field, s)) {
          for (const double t : {interval.enter, interval.exit}) {
            const double error = t > 0.0 && t < 1.0 ? rootError(field, s, t) : -1.0;
            if (error < 0.0) continue;
            const double spacings = error / (0x1p-52 * coordinate);
            ASSERT_LE(spacings, 16.0) << "of " << length << " m, at " << t;
            most = std::max(most, spacings);
            ++roots;
          }
        }
      }
    }
    EXPECT_GT(roots, 2000);
    EXPECT_GT(most, 1.0);
  }
}

TEST(SegmentBatch, HitsAreRightToAMillionthOfTheGridAndToWhatFloatsTellOfThePath) {
  for (const DistanceField& field : fieldsOfAllKinds()) {
    double most = 0.0;
    for (const double length : {0.5, 1e2, 1e4}) {
      const std::vector<Segment> segments = longSegments(length, 2000);
      BatchResult result;
      segmentIntervals(field, segments.data(), segments.size(), {}, result);
      ASSERT_GT(result.hits.size(), 500u);
      for (const SegmentHit& hit : result.hits) {
        for (const double t : {hit.enter, hit.exit}) {
          const double error = t > 0.0 && t < 1.0 ? rootError(field, segments[hit.segment], t) : -1.0;
          if (error < 0.0) continue;
          ASSERT_LE(error, 1e-6 * 0.6 + 6e-8 * length) << "of " << length << " m, at " << t;
          if (length > 1.0) most = std::max(most, error / length);
        }
      }
    }
    EXPECT_GT(most, 2e-8);
  }
}

/// Queries that stop early give the first of all intervals.
void expectFirstOfAll(const DistanceField& field) {
  Random random(8);
  int several = 0;
  for (int i = 0; i < 5000; ++i) {
    const Segment s = randomSegment(field, random, 0);
    const Intervals all = segmentIntervals(field, s),
                    first = segmentIntervals(field, s, {0.0, SegmentMode::kFirstInterval});
    const Intervals enter = segmentIntervals(field, s, {0.0, SegmentMode::kFirst});
    ASSERT_EQ(first.size(), std::min<std::size_t>(all.size(), 1));
    ASSERT_EQ(enter.size(), first.size());
    ASSERT_EQ(segmentIntervals(field, s, {0.0, SegmentMode::kAny}).size(), first.size());
    several += all.size() > 1;
    if (!first.empty()) {
      EXPECT_EQ(first[0].enter, all[0].enter);
      EXPECT_EQ(first[0].exit, all[0].exit);
      EXPECT_EQ(enter[0].enter, all[0].enter);
      EXPECT_EQ(enter[0].exit, all[0].enter);
    }
  }
  EXPECT_GT(several, 100);
}

TEST(SegmentQuery, FirstIsTheFirstOfAllOnATorus) {
  FieldOptions options;
  options.cells = 32;
  expectFirstOfAll(buildField(test::torusMesh(0.2, 0.08, 32, 16), options));
}

TEST(SegmentQuery, FirstIsTheFirstOfAllOnAnAdaptiveTorus) {
  FieldOptions options;
  options.max_error = 0.004;
  expectFirstOfAll(buildField(test::torusMesh(0.2, 0.08, 32, 16), options));
}

TEST(SegmentQuery, FirstIsTheFirstOfAllOnAPrimitive) {
  const DistanceField field(Primitive{Sphere{0.3}});
  Random random(8);
  const AlignedBox3d box(Vector3d::Constant(-0.5), Vector3d::Constant(0.5));
  for (int i = 0; i < 1000; ++i) {
    const Segment s{test::uniformIn(random, box), test::uniformIn(random, box)};
    const Intervals all = segmentIntervals(field, s), enter = segmentIntervals(field, s, {0.0, SegmentMode::kFirst});
    ASSERT_EQ(enter.size(), all.size());
    if (!all.empty()) {
      EXPECT_EQ(enter[0].exit, all[0].enter);
    }
  }
}

TEST(SegmentQuery, MayTouchNeverDeniesATouch) {
  FieldOptions options;
  options.cells = 32;
  const DistanceField field = buildField(test::torusMesh(0.2, 0.08, 48, 24), options);
  Random random(9);
  int denied = 0;
  for (int i = 0; i < 20000; ++i) {
    const Segment s = randomSegment(field, random, i);
    const double radius = test::uniform(random, 0.0, 0.3);
    if (mayTouch(field, s, radius)) continue;
    ++denied;
    for (int k = 0; k <= 20; ++k) {
      const FieldSample at = field.sample(s.start + k / 20.0 * (s.end - s.start));
      ASSERT_GT(at.value + at.error, radius);
    }
  }
  EXPECT_GT(denied, 2000);
}

TEST(SegmentQuery, OneHundredMetresPerSecondThroughAPlateOfOneMillimetre) {
  // A cycle of 1/30 s; the plate is crossed within 10 µs of it.
  const DistanceField plate{Primitive(Box::fromSize({1.0, 1.0, 0.001}))};
  const Intervals hit = segmentIntervals(plate, {{0, 0, 1.0}, {0, 0, 1.0 - 100.0 / 30}});
  ASSERT_EQ(hit.size(), 1U);
  EXPECT_NEAR(hit[0].exit - hit[0].enter, 0.001 / (100.0 / 30), 1e-12);
}

TEST(SegmentQuery, RefusesWhatIsNotFinite) {
  const DistanceField sphere{Primitive(Sphere{0.5})};
  EXPECT_THROW(segmentIntervals(sphere, {{NAN, 0, 0}, {1, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(segmentIntervals(sphere, {{0, 0, 0}, {INFINITY, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(segmentIntervals(sphere, {{1e308, 0, 0}, {-1e308, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(segmentIntervals(sphere, {{0, 0, 0}, {1, 0, 0}}, {NAN}), std::invalid_argument);
  FieldOptions options;
  options.cells = 16;
  const DistanceField field = buildField(test::boxMesh({0.1, 0.1, 0.1}), options);
  EXPECT_THROW(segmentIntervals(field, {{0, 0, 0}, {1, 0, 0}}, {field.band() * 1.01}), std::invalid_argument);
}

TEST(SegmentQuery, HugeAndTinySegments) {
  FieldOptions options;
  options.cells = 32;
  const DistanceField field = buildField(test::boxMesh({0.1, 0.1, 0.1}), options);
  const Intervals huge = segmentIntervals(field, {{-1e6, 0.01, 0.02}, {1e6, 0.01, 0.02}});
  ASSERT_EQ(huge.size(), 1U);
  EXPECT_NEAR((huge[0].exit - huge[0].enter) * 2e6, 0.2, 1e-3);
  EXPECT_EQ(segmentIntervals(field, {{0, 0, 0}, {0, 0, 0}}).size(), 1U);
  EXPECT_TRUE(segmentIntervals(field, {{0.2, 0, 0}, {0.2, 0, 0}}).empty());
  EXPECT_TRUE(segmentIntervals(field, {{5, 5, 5}, {6, 6, 6}}).empty());
}

TEST(SegmentQuery, SegmentsOfAnyLengthMeetTheBodyTheyPassThrough) {
  FieldOptions even, adaptive;
  even.cells = 40;
  adaptive.max_error = 0.005;
  Random random(12);
  for (const FieldOptions& options : {even, adaptive}) {
    const DistanceField field = buildField(test::boxMesh({0.3, 0.5, 0.7}), options);
    for (double length = 1e3; length <= 1e11; length *= 10.0) {
      for (int i = 0; i < 200; ++i) {
        const Vector3d middle = 0.05 * test::direction(random), half = 0.5 * length * test::direction(random);
        const Segment segment{middle - half, middle + half};
        for (const SegmentMode mode : {SegmentMode::kAll, SegmentMode::kFirst}) {
          ASSERT_FALSE(segmentIntervals(field, segment, {0.0, mode}).empty()) << length << " m";
        }
      }
    }
  }
}

/// Two boxes of one mesh overlap by half: what is inside both is no surface.
TEST(SegmentQuery, NothingIsCrossedWhereFacesOfASolidLieInside) {
  const TriangleMesh boxes =
      test::meshOf({test::boxAt({-0.25, 0, 0}, {0.5, 0.3, 0.3}), test::boxAt({0.25, 0, 0}, {0.5, 0.3, 0.3})});
  FieldOptions options;
  options.max_error = 4e-3;
  const DistanceField field = buildField(boxes, options);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const AlignedBox3d within(Vector3d(-0.74, -0.29, -0.29), Vector3d(0.74, 0.29, 0.29));
    const Segment segment{test::uniformIn(random, within), test::uniformIn(random, within)};
    const Intervals inside = segmentIntervals(field, segment);
    ASSERT_EQ(inside.size(), 1U);
    EXPECT_EQ(inside[0].enter, 0.0);
    EXPECT_EQ(inside[0].exit, 1.0);
  }
}

}  // namespace sdf_ccd::segment_query_test
