#include "sdf_ccd/query/segment_query.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "oracle/sampled_function.h"
#include "oracle/shapes.h"
#include "oracle/uniform_walk.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd {
namespace {

using test::Random;
using test::UniformWalk;

/// Segments per field; the full million of the issue is run by setting SDF_CCD_SEGMENTS.
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
  // Where a face is crossed is known to the rounding of places; on a short segment that is much of its time.
  const double place_time =
      1e-15 * test::latticeOf(field).box().sizes().maxCoeff() / std::max((segment.end - segment.start).norm(), 1e-300);
  const double tick = std::max(1e-12, 4.0 * place_time), time = std::max(1e-9, 4.0 * place_time);
  constexpr long double kRounding = 1e-13L;
  const UniformWalk walk(field, segment, sigma);
  const Intervals fast = segmentIntervals(field, segment, {sigma, false});
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
      // Spans that nearly touch may be one for the other side.
      matched = (sameTime(interval.enter, span.enter) || interval.enter < span.enter) &&
                (sameTime(interval.exit, span.exit) || interval.exit > span.exit);
      if (matched) break;
    }
    ASSERT_TRUE(matched) << "lost [" << double(span.enter) << ", " << double(span.exit) << "] " << double(span.lowest)
                         << " m deep, from " << segment.start.transpose() << " to " << segment.end.transpose()
                         << ", sigma " << sigma;
  }
  // What lies between two spans of the fast answer is outside.
  for (std::size_t i = 1; i < fast.size(); ++i) {
    const double middle = 0.5 * (fast[i - 1].exit + fast[i].enter);
    if (fast[i].enter - fast[i - 1].exit > time) {
      ASSERT_GE(walk.value(middle), -kRounding);
    }
  }
}

/// Random, short, axis-parallel, on faces, edges and corners of cells, and of no length.
Segment randomSegment(const DistanceField& field, Random& random, int kind) {
  const test::Lattice shape = test::latticeOf(field);
  const AlignedBox3d box = shape.box();
  const AlignedBox3d wide{box.min() - 0.1 * box.sizes(), box.max() + 0.1 * box.sizes()};
  Segment s{test::uniformIn(random, wide), test::uniformIn(random, wide)};
  const auto snap = [&](Vector3d p, int axes) {
    for (int k = 0; k < axes; ++k)
      p[k] = shape.origin[k] + shape.cell * std::round((p[k] - shape.origin[k]) / shape.cell);
    return p;
  };
  switch (kind % 8) {
    case 1:
      s.end = s.start + 3 * shape.cell * test::direction(random);
      break;
    case 2:
      s.end[0] = s.start[0];
      break;
    case 3:
      s.end[0] = s.start[0];
      s.end[1] = s.start[1];
      break;
    case 4:
      s = {snap(s.start, 1), snap(s.end, 1)};
      s.end[0] = s.start[0];
      break;
    case 5:
      s = {snap(s.start, 3), snap(s.end, 3)};
      break;
    case 6:
      s = {snap(s.start, 2), snap(s.end, 2)};
      s.end[0] = s.start[0];
      s.end[1] = s.start[1];
      break;
    case 7:
      s.end = s.start + test::uniform(random, 0, 1e-9) * test::direction(random);
      break;
    default:
      break;
  }
  return s;
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
  for (const int bits : {16, 32}) {
    FieldOptions options;
    options.cells = 48;
    options.sample_bits = bits;
    Agreement agreement;
    compareRandom(buildField(test::torusMesh(0.2, 0.08, 48, 24), options), 1, agreement);
    EXPECT_GT(agreement.spans, segmentCount() / 20);
  }
}

/// Sixteen bits move hits by their rounding, along paths that do not graze.
TEST(SegmentQuery, SixteenBitsMoveHitsByTheirRounding) {
  FieldOptions options;
  options.cells = 48;
  const TriangleMesh mesh = test::torusMesh(0.2, 0.08, 48, 24);
  const DistanceField steps = buildField(mesh, options);
  options.sample_bits = 32;
  const DistanceField floats = buildField(mesh, options);
  const double rounding = steps.grid()->rounding();
  Random random(12);
  long hits = 0, other = 0;
  for (int i = 0; i < segmentCount(); ++i) {
    const Segment s = randomSegment(floats, random, i % 4);
    const Intervals exact = segmentIntervals(floats, s), rounded = segmentIntervals(steps, s);
    other += exact.size() != rounded.size();
    if (exact.size() != rounded.size()) continue;
    for (std::size_t k = 0; k < exact.size(); ++k) {
      ++hits;
      for (const double t : {rounded[k].enter, rounded[k].exit}) {
        if (t == 0.0 || t == 1.0) continue;
        ASSERT_LE(std::abs(floats.sample(s.start + t * (s.end - s.start)).value), rounding + 1e-9);
      }
    }
  }
  EXPECT_GT(hits, segmentCount() / 20);
  EXPECT_LT(other, hits / 200);
}

TEST(SegmentQuery, EqualsUniformWalkOnThinPlate) {
  FieldOptions options;
  options.cells = 40;
  Agreement agreement;
  // A third of a cell thin: the interpolated field has hills and holes, and many double crossings.
  compareRandom(buildField(test::boxMesh({0.2, 0.15, 0.001}), options), 2, agreement);
  EXPECT_GT(agreement.spans, segmentCount() / 100);
}

/// Leaves of all sizes, with jumps between them: a segment that runs in a face has two answers, so none does here.
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
    if (std::max({std::abs(p.x()), 0.5 * std::abs(p.y()), std::abs(p.z())}) > 0.0799) return 1.0;  // as far away is
    Random random(std::uint64_t(std::llround(p.x() * 100) * 1000003 + std::llround(p.y() * 100) * 1009 +
                                std::llround(p.z() * 100)));
    return test::uniform(random, -1, 1);
  };
  const auto field = test::sampledFunction(noise, {2, 4, 2}, 0.01, 0.5);
  Agreement agreement;
  compareRandom(field, 4, agreement);
  EXPECT_GT(agreement.double_crossings, segmentCount() / 4);
  EXPECT_GT(agreement.spans, segmentCount());
}

TEST(SegmentQuery, EqualsUniformWalkWhenGrazing) {
  // Along the edges of a wave whose crests just reach the isosurface.
  const auto field = test::sampledFunction(
      [](const Vector3d& p) { return 0.02 * std::sin(60 * p.x()) * std::sin(50 * p.y()) + p.z(); }, {3, 3, 2}, 0.01,
      0.05);
  Random random(5);
  Agreement agreement;
  for (int i = 0; i < segmentCount(); ++i) {
    const AlignedBox3d box = test::latticeOf(field).box();
    Segment s{test::uniformIn(random, box), test::uniformIn(random, box)};
    // Start and end at the same height, at which a crest is just touched somewhere.
    const double height = field.sample(s.start).value - s.start.z();
    s.start.z() = s.end.z() = -height + test::uniform(random, -1e-6, 1e-6);
    expectAgreement(field, s, 0.0, agreement);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(agreement.spans, segmentCount() / 2);
  EXPECT_GT(agreement.grazing, segmentCount() / 100);
}

TEST(SegmentQuery, PaperSignTestLosesThisDoubleCrossing) {
  // Both ends of the cell's piece are outside, its middle is not.
  const auto field = test::sampledFunction(
      [](const Vector3d& p) { return std::abs(p.x()) < 1e-9 && std::abs(p.y()) < 1e-9 ? 0.01 : -0.01; }, {1, 1, 1}, 0.1,
      0.05);
  const Segment s{{-0.02, 0.0, 0.0}, {0.05, -0.05, 0.0}};
  Agreement agreement;
  expectAgreement(field, s, 0.0, agreement);
  EXPECT_GE(agreement.spans, 1);
}

TEST(SegmentQuery, SphereHasClosedForm) {
  const DistanceField sphere{Primitive(Sphere{0.5})};
  const Intervals hit = segmentIntervals(sphere, {{-1, 0.3, 0}, {1, 0.3, 0}});
  ASSERT_EQ(hit.size(), 1U);
  EXPECT_NEAR(hit[0].enter, 0.5 - 0.2, 1e-14);
  EXPECT_NEAR(hit[0].exit, 0.5 + 0.2, 1e-14);
  const Intervals wider = segmentIntervals(sphere, {{-1, 0, 0}, {1, 0, 0}}, {0.25, false});
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
  const std::vector<Primitive> solids{Sphere{0.3}, Box{{0.1, 0.3, 0.2}}, Cylinder{0.2, 0.3},
                                      HalfSpace{Vector3d(1, 2, -1).normalized(), 0.1}};
  int found = 0;
  for (int i = 0; i < 4000; ++i) {
    const DistanceField field{solids[i % 4]};
    const AlignedBox3d box{Vector3d::Constant(-0.7), Vector3d::Constant(0.7)};
    const Segment s{test::uniformIn(random, box), test::uniformIn(random, box)};
    const double sigma = i % 2 ? 0.0 : test::uniform(random, -0.05, 0.3);
    const Intervals hit = segmentIntervals(field, s, {sigma, false});
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

/// What stops early equals what is first in the whole.
void expectFirstOfAll(const DistanceField& field) {
  Random random(8);
  int several = 0;
  for (int i = 0; i < 5000; ++i) {
    const Segment s = randomSegment(field, random, 0);
    const Intervals all = segmentIntervals(field, s), first = segmentIntervals(field, s, {0.0, true});
    const Intervals enter = segmentIntervals(field, s, {0.0, false, true});
    ASSERT_EQ(first.size(), std::min<std::size_t>(all.size(), 1));
    ASSERT_EQ(enter.size(), first.size());
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
    const Intervals all = segmentIntervals(field, s), enter = segmentIntervals(field, s, {0.0, false, true});
    ASSERT_EQ(enter.size(), all.size());
    if (!all.empty()) EXPECT_EQ(enter[0].exit, all[0].enter);
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
  const DistanceField plate{Primitive(Box{{0.5, 0.5, 0.0005}})};
  const Intervals hit = segmentIntervals(plate, {{0, 0, 1.0}, {0, 0, 1.0 - 100.0 / 30}});
  ASSERT_EQ(hit.size(), 1U);
  EXPECT_NEAR(hit[0].exit - hit[0].enter, 0.001 / (100.0 / 30), 1e-12);
}

TEST(SegmentQuery, RefusesWhatIsNotFinite) {
  const DistanceField sphere{Primitive(Sphere{0.5})};
  EXPECT_THROW(segmentIntervals(sphere, {{NAN, 0, 0}, {1, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(segmentIntervals(sphere, {{0, 0, 0}, {INFINITY, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(segmentIntervals(sphere, {{1e308, 0, 0}, {-1e308, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(segmentIntervals(sphere, {{0, 0, 0}, {1, 0, 0}}, {NAN, false}), std::invalid_argument);
  FieldOptions options;
  options.cells = 16;
  const DistanceField field = buildField(test::boxMesh({0.1, 0.1, 0.1}), options);
  EXPECT_THROW(segmentIntervals(field, {{0, 0, 0}, {1, 0, 0}}, {field.band() * 1.01, false}), std::invalid_argument);
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

}  // namespace
}  // namespace sdf_ccd
