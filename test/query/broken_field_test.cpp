#include <cmath>

#include "field/field_file_case.h"
#include "oracle/mended_file.h"
#include "oracle/rounds.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::broken_field_test {

using BrokenField = test::FieldFileCase;

/// Queries the field everywhere, at points and along segments, one by one and in batches.
void expectNumbers(const DistanceField& field, test::Random& random) {
  const AlignedBox3d box(Vector3d::Constant(-0.6), Vector3d::Constant(0.6));
  std::vector<Segment> segments;
  for (int i = 0; i < 40; ++i) {
    const Vector3d p = test::uniformIn(random, box), q = test::uniformIn(random, box);
    const FieldSample sample = field.sample(p);
    ASSERT_FALSE(std::isnan(sample.value));
    ASSERT_FALSE(std::isnan(sample.error));
    segments.push_back({p, q});
    for (const Interval& interval : segmentIntervals(field, segments.back())) {
      ASSERT_LE(0.0, interval.enter);
      ASSERT_LE(interval.enter, interval.exit);
      ASSERT_LE(interval.exit, 1.0);
    }
  }
  BatchResult result;
  segmentIntervals(field, segments.data(), segments.size(), {}, result);
  for (const SegmentHit& hit : result.hits) ASSERT_LE(hit.enter, hit.exit + 1e-6F);
}

/// Whatever numbers a file with a valid checksum holds: it is refused, or queries end and return no NaN.
TEST_F(BrokenField, NoNumbersBreakQueries) {
  int refused = 0, queried = 0;
  for (const FieldOptions& options : {options_, adaptive()}) {
    saveField(buildField(test::binMesh(0.3), options), path("a.field"));
    const test::EditedFile good(path("a.field"), options.max_error ? "adaptive field" : "field", test::kFieldVersion);
    test::Random random(3);
    for (int i = 0; i < test::rounds(1500); ++i) {
      good.write(path("b.field"), [&](auto& sections) { test::breakNumbers(random, sections); });
      try {
        expectNumbers(loadField(path("b.field")), random);
        ++queried;
      } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("b.field"), std::string::npos);
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, test::rounds(500));
  EXPECT_GT(queried, test::rounds(500));
}

}  // namespace sdf_ccd::broken_field_test
