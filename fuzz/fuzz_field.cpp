// Fuzzes the sections of a field file (uniform or adaptive, a macro says which), then queries the field.
#include <cmath>

#include "oracle/file_versions.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"
#include "valid_file.h"

namespace sdf_ccd::fuzz {
namespace {

/// The i-th test point: in the box, on its faces, edges and corners, and outside.
Vector3d placeIn(const AlignedBox3d& box, unsigned i) {
  constexpr double kShares[] = {0.5, 0.0, 1.0, 0.3, 0.77, -0.4, 1.4};
  const Vector3d share(kShares[i % 7], kShares[i / 7 % 7], kShares[i / 3 % 7]);
  return box.min() + share.cwiseProduct(box.sizes());
}

void query(const DistanceField& field) {
  const AlignedBox3d box = field.box();
  std::vector<Segment> segments;
  for (unsigned i = 0; i < 49; ++i) {
    const Vector3d p = placeIn(box, i);
    const FieldSample sample = field.sample(p);
    require(!std::isnan(sample.value) && !std::isnan(sample.error), "samples are numbers");
    const DistanceBounds bounds = field.bounds(p);
    require(!std::isnan(bounds.low) && !std::isnan(bounds.high), "bounds are numbers");
    require(!std::isnan(field.openingDistance(p)), "the distance of openings is a number");
    segments.push_back({p, placeIn(box, 11 * i + 5)});
    if (!isWithinReach(segments.back())) segments.back() = {Vector3d::Zero(), Vector3d::Ones()};
    for (const Interval& interval : segmentIntervals(field, segments.back())) {
      require(0.0 <= interval.enter && interval.enter <= interval.exit && interval.exit <= 1.0,
              "intervals are in order");
    }
    mayTouch(field, segments.back(), 0.01);
  }
  BatchResult result;
  segmentIntervals(field, segments.data(), segments.size(), {}, result);
  for (const SegmentHit& hit : result.hits) {
    require(hit.segment < segments.size() && !std::isnan(hit.enter) && !std::isnan(hit.exit), "hits are numbers");
  }
}

}  // namespace
}  // namespace sdf_ccd::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  static const fuzz::InputFile file(".field");
  fuzz::attempt([&] {
    fuzz::writeWithChecksum(data, size, file, SDF_CCD_FUZZ_KIND, test::kFieldVersion);
    fuzz::query(loadField(file.path()));
  });
  return 0;
}
