#include "field/empty_sphere.h"

#include <gtest/gtest.h>

#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "field/uniform/sparse_grid.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/primitive.h"

namespace sdf_ccd::empty_sphere_test {

using test::Random;

TEST(EmptySphere, WordsHoldEveryBall) {
  for (const int x : {-15, -1, 0, 9, 15})
    for (const int y : {-15, 0, 3, 15})
      for (const int z : {-8, 0, 15})
        for (const int steps : {0, 1, 5000, EmptySphere::kMaxSteps})
          for (const bool inside : {false, true}) {
            const std::uint32_t word = EmptySphere{{x, y, z}, steps, inside}.word();
            ASSERT_EQ(word & 3U, 0U);
            const EmptySphere ball = EmptySphere::of(word);
            ASSERT_EQ(ball.offset, Vector3i(x, y, z));
            ASSERT_EQ(ball.steps, steps);
            ASSERT_EQ(ball.inside, inside);
          }
}

const Vector3d kHalf(0.3, 0.2, 0.1);

double boxDistance(const Vector3d& p) {
  return signedDistance(Primitive(Box::fromSize(2.0 * kHalf)), p);
}

/// Compares the empty spheres of a box's grid with the exact distance.
struct Tally {
  int far = 0, inside = 0, apart = 0;
  double mean_radius = 0.0, mean_distance = 0.0;  ///< of the balls; from the cells' centres

  void add(const Vector3d& cell_center, double cell_side, const Vector3d& center, double radius, bool says_inside) {
    const double truth = boxDistance(center);
    ASSERT_LE(radius, std::abs(truth) + 1e-7);
    ASSERT_EQ(says_inside, truth < 0.0);
    // All of the cell is on the same side.
    for (int k = 0; k < 8; ++k) {
      const Vector3d corner = cell_center + 0.5 * cell_side * Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
      ASSERT_EQ(says_inside, boxDistance(corner) < 0.0);
    }
    ++far;
    inside += says_inside;
    apart += (center - cell_center).norm() > cell_side;
    mean_radius += radius;
    mean_distance += std::abs(boxDistance(cell_center));
  }
};

TEST(EmptySphere, SpheresOfUniformGridsAreFreeOfSurface) {
  FieldOptions options;
  options.cells = 200;
  const DistanceField field = buildField(test::boxMesh(kHalf), options);
  const SparseGrid& grid = *FieldAccess::grid(field);
  const GridShape& shape = grid.shape();
  const double side = GridShape::kBrick * shape.cell;
  Tally tally;
  for (Vector3i b(0, 0, 0); b.z() < shape.bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < shape.bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < shape.bricks.x(); ++b.x()) {
        if (!brick_word::isFar(grid.word(b))) continue;
        const EmptySphere ball = EmptySphere::of(grid.word(b));
        const Vector3d center = shape.origin + side * (b + ball.offset).cast<double>();
        const Vector3d brick_center = shape.origin + side * (b.cast<double>().array() + 0.5).matrix();
        tally.add(brick_center, side, center, ball.steps * grid.ballStep(), ball.inside);
        if (HasFatalFailure()) return;
      }
  EXPECT_GT(tally.far, 500);
  EXPECT_GT(tally.inside, 20);
  EXPECT_GT(tally.apart, tally.far / 3);
  EXPECT_GT(tally.mean_radius, 1.3 * tally.mean_distance);
}

TEST(EmptySphere, BallsOfAdaptiveGridsAreFreeOfSurface) {
  FieldOptions options;
  options.max_error = 0.0005;
  const DistanceField field = buildField(test::boxMesh(kHalf), options);
  const AdaptiveGrid& grid = *FieldAccess::adaptive(field);
  const AdaptiveShape& shape = grid.shape();
  Tally tally;
  for (Vector3i c(0, 0, 0); c.z() < shape.size.z(); ++c.z())
    for (c.y() = 0; c.y() < shape.size.y(); ++c.y())
      for (c.x() = 0; c.x() < shape.size.x(); ++c.x()) {
        const AdaptiveBlock block = grid.block(AdaptiveShape::kUnits * c);
        if (block.leaf || block.side != AdaptiveShape::kUnits) continue;
        const Vector3d center = shape.origin + shape.unit() * block.ball_center;
        const Vector3d cell_center = shape.origin + shape.cell * (c.cast<double>().array() + 0.5).matrix();
        tally.add(cell_center, shape.cell, center, block.ball_radius, block.inside);
        if (HasFatalFailure()) return;
        ASSERT_LE(std::abs(boxDistance(cell_center)), block.upper_bound);
        ASSERT_GE(std::abs(boxDistance(cell_center)), block.upper_bound - 0.2 * shape.cell);
      }
  EXPECT_GT(tally.far, 500);
  EXPECT_GT(tally.apart, tally.far / 3);
  EXPECT_GT(tally.mean_radius, 1.3 * tally.mean_distance);
}

/// In far cells the bounds follow from the empty spheres; they hold at all points of the field's box.
TEST(EmptySphere, LowerBoundsHoldAwayFromTheSurface) {
  for (const bool adaptive : {false, true}) {
    FieldOptions options;
    if (adaptive)
      options.max_error = 0.0005;
    else
      options.cells = 200;
    const DistanceField field = buildField(test::boxMesh(kHalf), options);
    Random random(5);
    for (int i = 0; i < 100000; ++i) {
      const Vector3d p = test::uniformIn(random, field.box());
      const DistanceBounds bounds = field.bounds(p);
      ASSERT_LE(bounds.low, boxDistance(p) + 1e-9);
      ASSERT_GE(bounds.high, boxDistance(p) - 1e-9);
    }
  }
}

}  // namespace sdf_ccd::empty_sphere_test
