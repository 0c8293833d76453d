#include "query/sphere_sides.h"

#include <limits>

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "oracle/shapes.h"
#include "query/swept_side.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::sphere_sides_test {

using test::Random;

const BoundingBall kShell{{0.05, -0.02, 0.01}, 0.4};  // contains the spheres' centres

std::vector<DistanceField> buildFields() {
  const TriangleMesh torus = test::torusMesh(0.2, 0.08, 48, 24);
  std::vector<DistanceField> all;
  const auto add = [&](const TriangleMesh& mesh, int cells, double max_error) {
    FieldOptions options;
    if (cells > 0) options.cells = cells;
    if (max_error > 0.0) options.max_error = max_error;
    all.push_back(buildField(mesh, options));
  };
  add(torus, 0, 1e-3);
  add(torus, 48, 0.0);
  add(torus, 0, 4e-3);
  all.emplace_back(Sphere{0.15});
  all.emplace_back(Box::fromSize({0.4, 0.2, 0.1}));
  all.emplace_back(Cylinder::fromRadiusAndLength(0.1, 0.4));
  all.emplace_back(HalfSpace{Vector3d(1, 2, 3).normalized(), 0.05});
  return all;
}

const std::vector<DistanceField>& fields() {
  static const std::vector<DistanceField> all = buildFields();
  return all;
}

Chord chordOf(Random& random, double reach, double turn, double travel) {
  const Isometry3d start = test::pose(random, 3.0, reach);
  return {0.0, 1.0, start, test::pose(random, turn, travel) * start, 0};
}

/// Fills a group with spheres of all sizes, and points; most of them near the surfaces.
void fill(SphereGroup& group, Random& random, std::vector<std::pair<Vector3d, double>>& spheres) {
  spheres.clear();
  group.size = 0;
  for (int i = 0; i < SphereGroup::kCapacity; ++i) {
    const Vector3d p = kShell.center + kShell.radius * test::uniform(random, 0.0, 1.0) * test::direction(random);
    const double r = i % 3 == 0 ? 0.0 : std::pow(10.0, test::uniform(random, -4.0, -0.7));
    spheres.emplace_back(p, r);
    group.add(p, r);
  }
}

/// A sphere is on the reported side along its whole path, as far as the field's bounds can tell.
TEST(SphereSides, OutsideAndInsideHoldAllAlong) {
  Random random(1);
  std::vector<std::pair<Vector3d, double>> spheres;
  long outside = 0, inside = 0, sorts = 0;
  for (const DistanceField& field : fields()) {
    for (int i = 0; i < 60; ++i) {
      const double margin = field.errorBound() + (i % 3 ? 0.0 : test::uniform(random, 0.0, 1.0) * field.band());
      const Chord chord = i % 2 ? chordOf(random, 0.1, 0.02, 0.005) : chordOf(random, 0.6, 3.0, 0.6);
      SphereSides sides(field, margin, kShell);
      sides.begin(chord);
      sorts += sides.sortsPoints();
      fill(sides.group(), random, spheres);
      sides.testGroup();
      for (int k = 0; k < sides.group().size; ++k) {
        const auto& [p, r] = spheres[k];
        const SweptSide side = sides.group().sideOf(k);
        outside += side == SweptSide::kOutside;
        inside += side == SweptSide::kInside;
        if (side == SweptSide::kUnknown) continue;
        for (int s = 0; s <= 20; ++s) {
          const Vector3d at = (1.0 - s / 20.0) * (chord.X_FP_start * p) + s / 20.0 * (chord.X_FP_end * p);
          const FieldSample sample = field.sample(at);
          if (side == SweptSide::kOutside) {
            ASSERT_GT(sample.value + sample.error, r + margin) << "sphere of " << r << " at " << s / 20.0;
          } else {
            ASSERT_LT(sample.value - sample.error, -(r + margin)) << "sphere of " << r << " at " << s / 20.0;
          }
        }
      }
    }
  }
  if (!SphereSides(fields()[0], 0.0, kShell).inVectors()) GTEST_SKIP() << "no vectors";
  EXPECT_GT(outside, 10000);
  EXPECT_GT(inside, 200);
  EXPECT_LT(sorts, 60 * long(fields().size())) << "no long ways";
  EXPECT_GT(sorts, 0) << "no short ways";
}

/// Groups find nearly as many sides as sweptSide(), which follows short paths from one empty sphere to the next too.
TEST(SphereSides, TellsAsManyApartAsOneByOne) {
  Random random(2);
  std::vector<std::pair<Vector3d, double>> spheres;
  long single = 0, grouped = 0;
  for (const DistanceField& field : fields()) {
    for (int i = 0; i < 40; ++i) {
      const Chord chord = i % 2 ? chordOf(random, 0.1, 0.02, 0.005) : chordOf(random, 0.6, 3.0, 0.6);
      SphereSides sides(field, field.errorBound(), kShell);
      if (!sides.inVectors()) GTEST_SKIP() << "no vectors";
      sides.begin(chord);
      fill(sides.group(), random, spheres);
      sides.testGroup();
      for (int k = 0; k < sides.group().size; ++k) {
        grouped += sides.group().sideOf(k) != SweptSide::kUnknown;
        single += sides.of(spheres[k].first, spheres[k].second) != SweptSide::kUnknown;
      }
    }
  }
  EXPECT_GT(single, 10000);
  EXPECT_GT(grouped, 0.93 * single);
}

TEST(SphereSides, NothingIsKnownOnAPathThatIsNotFinite) {
  Random random(3);
  std::vector<std::pair<Vector3d, double>> spheres;
  for (const DistanceField& field : fields()) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      for (int k = 0; k < 3; ++k) {
        Chord chord = chordOf(random, 0.1, 0.1, 0.1);
        chord.X_FP_end.translation()[k] = bad;
        SphereSides sides(field, field.errorBound(), kShell);
        sides.begin(chord);
        fill(sides.group(), random, spheres);
        sides.testGroup();
        for (int i = 0; i < sides.group().size; ++i) ASSERT_EQ(sides.group().sideOf(i), SweptSide::kUnknown);
      }
    }
  }
}

TEST(SphereSides, FarFromTheFieldAllIsOutside) {
  Random random(4);
  std::vector<std::pair<Vector3d, double>> spheres;
  for (const DistanceField& field : fields()) {
    SphereSides sides(field, field.errorBound(), kShell);
    if (!sides.inVectors()) GTEST_SKIP() << "no vectors";
    for (const double travel : {0.0, 1e-3, 10.0}) {
      Chord chord = chordOf(random, 0.0, 0.0, 0.0);
      chord.X_FP_start.translation().x() += 1000.0;
      chord.X_FP_end.translation() = chord.X_FP_start.translation() + travel * Vector3d::UnitY();
      sides.begin(chord);
      fill(sides.group(), random, spheres);
      sides.testGroup();
      for (int i = 0; i < sides.group().size; ++i) ASSERT_EQ(sides.group().sideOf(i), SweptSide::kOutside);
    }
  }
}

}  // namespace sdf_ccd::sphere_sides_test
