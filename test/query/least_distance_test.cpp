#include "query/least_distance.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "field/signed_surface.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::least_distance_test {

using test::Random;

constexpr double kTolerance = 1e-5;  ///< of the reference distances [m]

Vector3d placeAt(const Segment& segment, double t) {
  return segment.start + t * (segment.end - segment.start);
}

/// The least distance of a segment, or up to `tolerance` [m] more: the distance is 1-Lipschitz.
template <class Distance>
double leastOn(const Segment& segment, double tolerance, const Distance& distance) {
  struct Piece {
    double from, to, at_from, at_to;
  };
  const double length = (segment.end - segment.start).norm();
  std::vector<Piece> pieces{{0.0, 1.0, distance(segment.start), distance(segment.end)}};
  double least = std::min(pieces[0].at_from, pieces[0].at_to);
  while (!pieces.empty()) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    if (0.5 * (piece.at_from + piece.at_to - (piece.to - piece.from) * length) > least - tolerance) continue;
    const double middle = 0.5 * (piece.from + piece.to), at_middle = distance(placeAt(segment, middle));
    least = std::min(least, at_middle);
    pieces.push_back({piece.from, middle, piece.at_from, at_middle});
    pieces.push_back({middle, piece.to, at_middle, piece.at_to});
  }
  return least;
}

/// A random segment about a box; kinds: 0 any, 1 short, 2 parallel to a face, up to a band beside it, 3 into the
/// middle, beyond the band.
Segment segmentAbout(const AlignedBox3d& box, double band, int kind, Random& random) {
  const AlignedBox3d around{1.5 * box.min(), 1.5 * box.max()};
  Segment segment{test::uniformIn(random, around), test::uniformIn(random, around)};
  if (kind == 1) segment.end = segment.start + 0.02 * test::direction(random);
  if (kind == 2) segment.start.z() = segment.end.z() = box.max().z() + band * test::uniform(random, -1.0, 1.0);
  if (kind == 3) segment.end = 0.3 * test::uniformIn(random, box);
  return segment;
}

/// Bounds of depths, compared with a mesh's exact distances.
struct Tally {
  std::vector<double> bounds, ratios;  ///< of the errors of depths in the band [m]; the same over the true errors
  int deep = 0, far = 0;               ///< paths beyond the band, inside and out

  static double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  }
};

/// Compares depths below the isosurface σ: that of the deepest point in the interpolated field, and the exact one.
void expectHonestDepth(const DistanceField& field, const Segment& segment, double sigma, double exact, Tally& tally) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Interval& interval : segmentIntervals(field, segment, {sigma})) {
    for (int i = 0; i <= 200; ++i) {
      const double t = interval.enter + 0.005 * i * (interval.exit - interval.enter);
      deepest = std::max(deepest, sigma - field.interpolate(placeAt(segment, t)).value);
    }
  }
  if (deepest < 0.0) return;
  const LeastDistance least = leastDistance(field, segment);
  const double most = sigma - least.low, at_least = sigma - least.high;
  const double bound = std::max(deepest - at_least, most - deepest), error = std::abs(deepest - (sigma - exact));
  EXPECT_LE(error, bound + kTolerance) << sigma;
  if (std::abs(exact) > field.band() - field.errorBound()) return;
  EXPECT_LE(bound, 1.5 * field.errorBound()) << sigma;
  tally.bounds.push_back(bound);
  tally.ratios.push_back(bound / std::max(error, kTolerance));
}

template <class Distance>
Tally expectHonest(const TriangleMesh& mesh, const FieldOptions& options, const Distance& distance) {
  const DistanceField field = buildField(mesh, options);
  Random random(11);
  Tally tally;
  for (int i = 0; i < 1200 && !testing::Test::HasFailure(); ++i) {
    const Segment segment = segmentAbout(field.surfaceBox(), field.band(), i % 4, random);
    const double exact = leastOn(segment, kTolerance, distance);
    const LeastDistance least = leastDistance(field, segment);
    EXPECT_LE(least.low, exact + 1e-9) << i;
    EXPECT_GE(least.high, exact - kTolerance - 1e-9) << i;
    EXPECT_NEAR(least.value, field.sample(placeAt(segment, least.time)).value, field.errorBound()) << i;
    tally.deep += exact < -field.band();
    tally.far += exact > field.band();
    for (const double sigma : {-0.3 * field.band(), 0.0, 0.3 * field.band()}) {
      expectHonestDepth(field, segment, sigma, exact, tally);
    }
  }
  EXPECT_GT(tally.bounds.size(), 150U);
  EXPECT_GT(tally.deep, 100);
  EXPECT_GT(tally.far, 100);
  return tally;
}

const Vector3d kHalf(0.1, 0.075, 0.05);

/// Flat, with edges inside and out.
Tally box(const FieldOptions& options) {
  return expectHonest(test::boxMesh(kHalf), options,
                      [](const Vector3d& p) { return signedDistance(Box::fromSize(2.0 * kHalf), p); });
}

/// Curved both ways, with a hole.
Tally torus(const FieldOptions& options) {
  const TriangleMesh mesh = test::torusMesh(0.07, 0.04, 24, 12);
  const SignedSurface surface(mesh);
  return expectHonest(mesh, options, [&](const Vector3d& p) { return surface.signedDistance(p); });
}

TEST(LeastDistance, HoldsTheDepthsOfUniformFields) {
  FieldOptions options;
  options.cells = 32;
  const double cell = 0.2 / 32;
  EXPECT_LT(Tally::median(box(options).bounds), 0.1 * cell);
  const Tally curved = torus(options);
  EXPECT_LT(Tally::median(curved.bounds), 0.1 * cell);
  EXPECT_LT(Tally::median(curved.ratios), 3.0);
}

TEST(LeastDistance, HoldsTheDepthsOfAdaptiveFields) {
  FieldOptions options;
  options.max_error = 0.001;
  options.band = 0.01;
  const Tally flat = box(options), curved = torus(options);
  EXPECT_LT(Tally::median(flat.bounds), 0.95 * 0.001);
  EXPECT_LT(Tally::median(flat.ratios), 10.0);
  EXPECT_LT(Tally::median(curved.ratios), 10.0);
}

TEST(LeastDistance, OfPrimitivesIsExact) {
  const std::vector<Primitive> primitives = {Sphere{0.1}, Box::fromSize(2.0 * kHalf),
                                             Cylinder::fromRadiusAndLength(0.08, 0.1),
                                             HalfSpace{Vector3d(0.6, 0.0, 0.8), 0.01}};
  Random random(3);
  for (const Primitive& primitive : primitives) {
    const DistanceField field(primitive);
    for (int i = 0; i < 300; ++i) {
      const Segment segment = segmentAbout({-kHalf, kHalf}, 0.02, i % 4, random);
      const LeastDistance least = leastDistance(field, segment);
      // Convex along the segment.
      double from = 0.0, to = 1.0;
      const auto at = [&](double t) { return signedDistance(primitive, placeAt(segment, t)); };
      for (int k = 0; k < 200; ++k) {
        const double a = from + (to - from) / 3.0, b = to - (to - from) / 3.0;
        (at(a) < at(b) ? to : from) = at(a) < at(b) ? b : a;
      }
      const double exact = std::min({at(from), at(0.0), at(1.0)});
      EXPECT_LE(least.low, exact + 1e-15) << primitive.index() << ' ' << i;
      EXPECT_GE(least.high, exact - 1e-15) << primitive.index() << ' ' << i;
      EXPECT_LE(least.high - least.low, 2e-9) << primitive.index() << ' ' << i;
    }
  }
}

TEST(LeastDistance, OfAPointAtRestIsThatOfItsPlace) {
  FieldOptions options;
  options.cells = 32;
  const DistanceField field = buildField(test::boxMesh(kHalf), options);
  const Vector3d p(0.01, 0.0, 0.045);
  const FieldSample sample = field.sample(p);
  const LeastDistance least = leastDistance(field, {p, p});
  EXPECT_EQ(least.value, sample.value);
  EXPECT_LE(least.low, sample.value - sample.error);
  EXPECT_GE(least.high, sample.value + sample.error);
  EXPECT_NEAR(least.low, sample.value - sample.error, 1e-14);
  EXPECT_NEAR(least.high, sample.value + sample.error, 1e-14);
}

TEST(LeastDistance, RefusesSegmentsOutOfReach) {
  const DistanceField field{Primitive(Sphere{0.1})};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(leastDistance(field, {Vector3d::Zero(), Vector3d(nan, 0.0, 0.0)}), std::invalid_argument);
  EXPECT_THROW(leastDistance(field, {Vector3d::Zero(), Vector3d(2e12, 0.0, 0.0)}), std::invalid_argument);
}

}  // namespace sdf_ccd::least_distance_test
