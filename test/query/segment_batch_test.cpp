#include "sdf_ccd/segments.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "oracle/failure.h"
#include "query/batch_case.h"

namespace sdf_ccd::segment_batch_test {

using namespace test;

TEST(SegmentBatch, PrimitivesGiveTheSingleQuerysIntervals) {
  for (const DistanceField& field :
       {DistanceField(Primitive(Sphere{0.3})), DistanceField(Primitive(Box::fromSize({0.4, 0.2, 0.6})))}) {
    const AlignedBox3d box{Vector3d::Constant(-0.4), Vector3d::Constant(0.4)};
    Random random(3);
    std::vector<Segment> segments;
    for (int i = 0; i < 5000; ++i) segments.push_back({test::uniformIn(random, box), test::uniformIn(random, box)});
    BatchResult result;
    segmentIntervals(field, segments.data(), segments.size(), {0.01, SegmentMode::kAll}, result);
    std::size_t next = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (const Interval& interval : segmentIntervals(field, segments[i], {0.01})) {
        ASSERT_LT(next, result.hits.size());
        ASSERT_EQ(result.hits[next].segment, i);
        ASSERT_EQ(result.hits[next].enter, float(interval.enter));
        ASSERT_EQ(result.hits[next++].exit, float(interval.exit));
      }
    }
    EXPECT_EQ(next, result.hits.size());
    EXPECT_GT(next, 1000U);
  }
}

TEST(SegmentBatch, DoesNotDependOnThreads) {
  const DistanceField field = torus();
  const std::vector<Segment> segments = randomSegments(field, 20000);
  BatchResult many, single;
  segmentIntervals(field, segments.data(), segments.size(), {0.0, SegmentMode::kAll}, many);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  segmentIntervals(field, segments.data(), segments.size(), {0.0, SegmentMode::kAll}, single);
  ASSERT_EQ(many.hits.size(), single.hits.size());
  for (std::size_t i = 0; i < many.hits.size(); ++i) {
    ASSERT_EQ(many.hits[i].segment, single.hits[i].segment);
    ASSERT_EQ(many.hits[i].enter, single.hits[i].enter);
    ASSERT_EQ(many.hits[i].exit, single.hits[i].exit);
  }
}

/// Segments share vectors, and some steps are done for all lanes if one needs them, e.g. for segments far away or those
/// that leave the box.
TEST(SegmentBatch, DoesNotDependOnTheOtherSegments) {
  for (const DistanceField& field : {torus(), uniformTorus()}) {
    std::vector<Segment> segments = randomSegments(field, 5000);
    const auto ask = [&] {
      BatchResult result;
      segmentIntervals(field, segments.data(), segments.size(), {}, result);
      return result.hits;
    };
    const std::vector<SegmentHit> forward = ask();
    std::reverse(segments.begin(), segments.end());
    std::vector<SegmentHit> backward = ask();
    ASSERT_EQ(forward.size(), backward.size());
    for (SegmentHit& hit : backward) hit.segment = static_cast<std::uint32_t>(segments.size() - 1 - hit.segment);
    std::stable_sort(backward.begin(), backward.end(),
                     [](const SegmentHit& a, const SegmentHit& b) { return a.segment < b.segment; });
    for (std::size_t i = 0; i < forward.size(); ++i) {
      ASSERT_EQ(forward[i].segment, backward[i].segment);
      ASSERT_EQ(forward[i].enter, backward[i].enter);
      ASSERT_EQ(forward[i].exit, backward[i].exit);
    }
  }
}

TEST(SegmentBatch, DefinedForNoSegmentsNoLengthAndNoGrid) {
  const DistanceField field = torus();
  BatchResult result;
  segmentIntervals(field, nullptr, 0, {}, result);
  EXPECT_TRUE(result.hits.empty());
  const Vector3d in_tube(0.2, 0, 0), far(1e9, 0, 0);
  const std::vector<Segment> segments{{in_tube, in_tube}, {far, far}, {-far, far}, {far, 2.0 * far}, {in_tube, far}};
  segmentIntervals(field, segments.data(), segments.size(), {0.0, SegmentMode::kAll}, result);
  ASSERT_EQ(result.hits.size(), 4U);
  EXPECT_EQ(result.hits[0].segment, 0U);
  EXPECT_EQ(result.hits[0].enter, 0.0F);
  EXPECT_EQ(result.hits[0].exit, 1.0F);
  EXPECT_EQ(result.hits[1].segment, 2U);  // twice through the tube
  EXPECT_EQ(result.hits[2].segment, 2U);
  EXPECT_EQ(result.hits[3].segment, 4U);
  EXPECT_EQ(result.hits[3].enter, 0.0F);
}

/// Segments that miss the grid's box are complete at once; those after them must still be queried.
TEST(SegmentBatch, GoesOnAfterManyThatMissTheBox) {
  for (const DistanceField& field : {torus(), uniformTorus()}) {
    std::vector<Segment> segments(3000, {Vector3d(5, 5, 5), Vector3d(6, 5, 5)});
    segments.push_back({Vector3d(0.2, 0, -0.2), Vector3d(0.2, 0, 0.2)});
    for (const SegmentMode mode : {SegmentMode::kFirst, SegmentMode::kAll}) {
      BatchResult result;
      segmentIntervals(field, segments.data(), segments.size(), {0.0, mode}, result);
      ASSERT_EQ(result.hits.size(), 1U);
      EXPECT_EQ(result.hits[0].segment, 3000U);
    }
  }
}

TEST(SegmentBatch, RefusesWhatIsNotFiniteOrOutsideTheBand) {
  const DistanceField field = torus();
  std::vector<Segment> segments(3, Segment{Vector3d::Zero(), Vector3d::Ones()});
  BatchResult result;
  EXPECT_THROW(segmentIntervals(field, segments.data(), 3, {1.0, SegmentMode::kAll}, result), std::invalid_argument);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e308}) {
    segments[1].end.y() = bad;
    EXPECT_THROW(segmentIntervals(field, segments.data(), 3, {}, result), std::invalid_argument);
  }
}

TEST(SegmentBatch, NamesTheSegmentThatItRefuses) {
  for (const DistanceField& field : {torus(), uniformTorus(), DistanceField(Primitive(Sphere{0.1}))}) {
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 3e12}) {
      for (int k = 0; k < 6; ++k) {
        std::vector<Segment> segments(40, Segment{Vector3d::Zero(), Vector3d::Constant(0.01)});
        (k < 3 ? segments[21].start : segments[21].end)[k % 3] = bad;
        BatchResult result;
        const std::string failure = test::failureOf<std::invalid_argument>(
            [&] { segmentIntervals(field, segments.data(), segments.size(), {}, result); });
        EXPECT_NE(failure.find("segment 21 "), std::string::npos) << bad << " at " << k << ": \"" << failure << "\"";
      }
    }
  }
}

}  // namespace sdf_ccd::segment_batch_test
