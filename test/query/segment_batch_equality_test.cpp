#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
#include <memory>

#include <gtest/gtest.h>

#ifdef SDF_CCD_HIGHWAY
#include <hwy/targets.h>

#include "query/lanes/segment_lanes.h"
#endif

#include "field/field_access.h"
#include "oracle/random.h"
#include "oracle/sampled_function.h"
#include "query/batch_case.h"

namespace sdf_ccd::segment_batch_equality_test {

using namespace test;

/// Fields of boxes with faces on planes of the grid, where samples are exactly zero.
std::vector<DistanceField> boxesOnTheGrid() {
  std::vector<DistanceField> fields;
  for (const int cells : {10, 16, 20, 64})
    for (const Vector3d& half : {Vector3d(0.5, 0.5, 0.5), {0.5, 0.4, 0.2}}) {
      FieldOptions options;
      options.cells = cells;
      fields.push_back(buildField(test::boxMesh(half), options));
    }
  return fields;
}

/// Segments that pass through a box near one of its edges.
std::vector<Segment> segmentsAcrossEdges(const DistanceField& field, int count) {
  Random random(31);
  const AlignedBox3d box = field.surfaceBox();
  const double cell = field.box().sizes().maxCoeff() / 30.0;
  std::vector<Segment> segments;
  for (int i = 0; i < count; ++i) {
    const int along = i % 3;
    Vector3d edge = box.corner(static_cast<AlignedBox3d::CornerType>(random() % 8));
    edge[along] = test::uniform(random, box.min()[along], box.max()[along]);
    const Vector3d middle = edge + test::uniform(random, 0.0, 2.0) * cell * test::direction(random);
    const Vector3d half = test::uniform(random, 0.2, 6.0) * cell * test::direction(random);
    segments.push_back({middle - half, middle + half});
  }
  return segments;
}

/// The interpolated field minus sigma, at time t of a segment [m].
double valueAt(const DistanceField& field, const Segment& s, double t, double sigma) {
  return field.sample(s.start + t * (s.end - s.start)).value - sigma;
}

/// Distance of a point in a box from the nearest face; negative outside.
double toFaces(const AlignedBox3d& box, const Vector3d& p) {
  return std::min((p - box.min()).minCoeff(), (box.max() - p).minCoeff());
}

/// Where the two results differ, the segment must graze: the field there is within the tolerance of sigma.
void expectSame(const DistanceField& field, const Segment& s, const Intervals& exact, const Intervals& batch,
                double sigma) {
  // Leaves of an adaptive field jump by up to twice the error where they meet, and single precision may cut a corner.
  const double jump = FieldAccess::adaptive(field) ? 2.0 * field.errorBound() : 0.0;
  const double tolerance = jump + 2e-6 * field.box().sizes().maxCoeff();
  const auto covers = [](const Intervals& intervals, double t) {
    for (const Interval& i : intervals)
      if (i.enter <= t && t <= i.exit) return true;
    return false;
  };
  std::vector<double> times{0.0, 1.0};
  for (const Intervals* intervals : {&exact, &batch})
    for (const Interval& i : *intervals) times.insert(times.end(), {i.enter, i.exit});
  std::sort(times.begin(), times.end());
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const double t = 0.5 * (times[k] + times[k + 1]);
    if (covers(exact, t) == covers(batch, t)) continue;
    const double length = (times[k + 1] - times[k]) * (s.end - s.start).norm();
    const double resolution = 3e-7 * ((s.end - s.start).norm() + field.box().sizes().maxCoeff());
    if (length <= resolution) continue;
    // Beyond the box nothing is inside, and single precision may enter it early.
    const Vector3d p = s.start + t * (s.end - s.start);
    if (std::abs(toFaces(field.box(), p)) <= tolerance) continue;
    ASSERT_LE(std::abs(valueAt(field, s, t, sigma)), tolerance)
        << "from " << s.start.transpose() << " to " << s.end.transpose() << " at " << t << ", sigma " << sigma;
  }
}

struct Compared {
  long hits = 0;
  long differing = 0;  ///< segments with another number of intervals
};

Compared compare(const DistanceField& field, const std::vector<Segment>& segments, double sigma) {
  BatchResult all, first, intervals, any;
  segmentIntervals(field, segments.data(), segments.size(), {sigma, SegmentMode::kAll}, all);
  segmentIntervals(field, segments.data(), segments.size(), {sigma, SegmentMode::kFirst}, first);
  segmentIntervals(field, segments.data(), segments.size(), {sigma, SegmentMode::kFirstInterval}, intervals);
  segmentIntervals(field, segments.data(), segments.size(), {sigma, SegmentMode::kAny}, any);
  EXPECT_EQ(intervals.hits.size(), first.hits.size());
  EXPECT_EQ(any.hits.size(), first.hits.size());
  if (testing::Test::HasFailure()) return {};
  std::vector<Intervals> batch(segments.size());
  std::uint32_t last = 0;
  for (const SegmentHit& hit : all.hits) {
    EXPECT_GE(hit.segment, last);
    EXPECT_LE(hit.enter, hit.exit);
    if (!batch[hit.segment].empty()) {
      EXPECT_GE(hit.enter, batch[hit.segment].back().exit - 1e-6);
    }
    last = hit.segment;
    batch[hit.segment].push_back({hit.enter, hit.exit});
  }
  Compared compared;
  std::size_t next = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Intervals exact = segmentIntervals(field, segments[i], {sigma});
    expectSame(field, segments[i], exact, batch[i], sigma);
    compared.hits += !exact.empty();
    compared.differing += exact.size() != batch[i].size();
    const bool has_first = next < first.hits.size() && first.hits[next].segment == i;
    EXPECT_EQ(has_first, !batch[i].empty());
    if (has_first && !batch[i].empty()) {
      EXPECT_EQ(first.hits[next].enter, float(batch[i][0].enter));
      EXPECT_EQ(first.hits[next].exit, first.hits[next].enter);
      EXPECT_EQ(intervals.hits[next].segment, i);
      EXPECT_EQ(intervals.hits[next].enter, float(batch[i][0].enter));
      EXPECT_EQ(intervals.hits[next].exit, float(batch[i][0].exit));
    }
    next += has_first;
    if (testing::Test::HasFailure()) break;
  }
  return compared;
}

TEST(SegmentBatch, EqualsSingleQueries) {
  for (const DistanceField& field : {torus(), uniformTorus()}) {
    const std::vector<Segment> segments = randomSegments(field, 30000);
    for (const double sigma : {0.0, 0.004, -0.004}) {
      const Compared compared = compare(field, segments, sigma);
      EXPECT_GT(compared.hits, 3000);
      EXPECT_LT(compared.differing, 30);  // grazing, or two leaves whose values differ at their face
    }
  }
}

/// In a cell with a sample of exactly zero, a segment may enter or leave where its value is zero at the cell's face.
TEST(SegmentBatch, EqualsSingleQueriesWhereFacesLieOnTheGrid) {
  for (const DistanceField& field : boxesOnTheGrid()) {
    const std::vector<Segment> segments = segmentsAcrossEdges(field, 20000);
    const Compared compared = compare(field, segments, 0.0);
    EXPECT_GT(compared.hits, 3000);
    EXPECT_LT(compared.differing, 2000) << "by hits of no length beside others";
    if (testing::Test::HasFailure()) break;
  }
}

/// Where all corners of a cell's face are zero, rounding makes the cubic nearly zero at its end, of either sign.
TEST(SegmentBatch, EqualsSingleQueriesWhereEverySecondPlaneIsZero) {
  Random random(78);
  for (int trial = 1; trial <= 10; ++trial) {
    const auto value = [&](const Vector3d& p) {  // anything between samples
      return std::lround(p.x() / 0.05) % 2 == 0 ? 0.0 : 0.024 * std::sin(100.0 * trial * p.dot(Vector3d(5, 7, 11)));
    };
    const DistanceField field = test::sampledFunction(value, Vector3i(2, 2, 1), 0.05, 0.0075);
    std::vector<Segment> segments;
    for (int i = 0; i < 20000; ++i) {
      const Vector3d start = test::uniformIn(random, field.box());
      segments.push_back({start, start + test::uniform(random, 0.05, 0.3) * test::direction(random)});
    }
    compare(field, segments, 0.0);
    if (testing::Test::HasFailure()) break;
  }
}

/// The samples' magnitudes are at most half a cell, so that no sample has an empty sphere to skip by.
TEST(SegmentBatch, EqualsSingleQueriesOnNoise) {
  Random random(77);
  const DistanceField field = test::sampledFunction(
      [&](const Vector3d&) { return test::uniform(random, -0.025, 0.025); }, Vector3i(2, 2, 1), 0.05, 0.0075);
  const Compared compared = compare(field, randomSegments(field, 3000), 0.0025);
  EXPECT_GT(compared.hits, 1000);
}

/// Samples of 16 bits are read two at a time, but never beyond the last one, where a mapped file may end.
TEST(SegmentBatch, ReadsNothingBeyondTheSamples) {
  const DistanceField field = uniformTorus();
  const SparseGrid& grid = *FieldAccess::grid(field);
  const std::size_t bytes = grid.samples().size * sizeof(std::int16_t);
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), pages = (bytes + page - 1) / page * page;
  char* memory =
      static_cast<char*>(mmap(nullptr, pages + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  ASSERT_NE(memory, MAP_FAILED);
  ASSERT_EQ(mprotect(memory + pages, page, PROT_NONE), 0);
  std::memcpy(memory + pages - bytes, grid.samples().data, bytes);
  const View<std::int16_t> samples{reinterpret_cast<const std::int16_t*>(memory + pages - bytes), grid.samples().size};
  const DistanceField at_end = FieldAccess::make(std::make_shared<const SparseGrid>(
      grid.shape(), SparseGrid::Arrays{grid.corners(), grid.words(), samples}, grid.errorBound(), nullptr));
  EXPECT_GT(compare(at_end, randomSegments(field, 30000), 0.0).hits, 3000);
  // The last brick's last corner, from all sides.
  Vector3i brick(0, 0, 0);
  for (const auto last = static_cast<std::int32_t>(grid.samples().size / GridShape::kSamples) - 1;
       grid.slot(brick) != last;) {
    if (++brick.x() == grid.shape().bricks.x()) brick = {0, brick.y() + 1, brick.z()};
    if (brick.y() == grid.shape().bricks.y()) brick = {0, 0, brick.z() + 1};
  }
  const Vector3d corner = grid.shape().origin + grid.shape().cell * (8 * brick.array() + 8).cast<double>().matrix();
  Random random(5);
  std::vector<Segment> segments;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d start = corner + 3.0 * grid.shape().cell * test::direction(random);
    segments.push_back({start, 2.0 * corner - start});
  }
  compare(at_end, segments, 0.0);
  munmap(memory, pages + page);
}

#ifdef SDF_CCD_HIGHWAY
TEST(SegmentBatch, FollowsEverySegmentToItsEnd) {
  // A segment that is not completed is queried again by itself: correct, but as slow as thousands in a batch.
  FieldOptions options;
  options.max_error = 0.0003;
  const DistanceField fine = buildField(test::torusMesh(0.2, 0.08, 48, 24), options), even = uniformTorus();
  constexpr int kCount = RayWork::kSegments, kChunks = 24;
  const std::vector<Segment> segments = randomSegments(fine, kChunks * kCount);
  const auto work = std::make_unique<RayWork>();
  const auto follow = [&](const auto& lanes, bool first_only) {
    for (int i = 0; i < kChunks; ++i) {
      ASSERT_EQ(followRays(lanes, first_only, segments.data() + i * kCount, kCount, *work), -1);
      EXPECT_TRUE(work->unfinished.empty()) << work->unfinished.size() << " of chunk " << i;
    }
  };
  for (const bool first_only : {true, false}) {
    follow(AdaptiveLanes(*FieldAccess::adaptive(fine), 0.0), first_only);
    follow(UniformLanes(*FieldAccess::grid(even), 0.0), first_only);
  }
}

TEST(SegmentBatch, EqualsSingleQueriesOnEveryKindOfProcessor) {
  const DistanceField field = torus(), even = uniformTorus();
  const std::vector<Segment> segments = randomSegments(field, 4000);
  const std::vector<DistanceField> boxes = boxesOnTheGrid();
  int kinds = 0;
  for (std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS; targets != 0; targets &= targets - 1) {
    const std::int64_t target = targets & -targets;
    SCOPED_TRACE(hwy::TargetName(static_cast<decltype(HWY_TARGET)>(target)));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GT(compare(field, segments, 0.0).hits, 300);
    EXPECT_GT(compare(even, segments, 0.0).hits, 300);
    for (const DistanceField& box : boxes) EXPECT_GT(compare(box, segmentsAcrossEdges(box, 3000), 0.0).hits, 300);
    ++kinds;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GE(kinds, 1);
}
#endif

}  // namespace sdf_ccd::segment_batch_equality_test
