#include "contact/smooth_piece.h"

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "oracle/shapes.h"
#include "query/smooth_pieces.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::smooth_piece_test {

using namespace test;

const Vector3d kHalf(0.3, 0.2, 0.1);

std::vector<DistanceField> fields() {
  FieldOptions uniform, adaptive;
  uniform.cells = 40;
  adaptive.max_error = 0.002;
  adaptive.cells.reset();
  return {DistanceField(Primitive(Box::fromSize(2.0 * kHalf))),
          DistanceField(Primitive(HalfSpace{Vector3d(0.6, 0.0, 0.8), 0.05})), buildField(boxMesh(kHalf), uniform),
          buildField(boxMesh(kHalf), adaptive)};
}

/// The field's own values and gradients along the piece.
void expectThatOf(const DistanceField& field, const Vector3d& from, const Vector3d& to, const SmoothPiece& piece) {
  for (const double u : {1e-6, 0.3, 0.5, 0.8, 1.0 - 1e-6})
    ASSERT_NEAR(piece.distance(u), field.interpolate(from + u * (to - from)).value, 1e-9)
        << from.transpose() << " to " << to.transpose();
  for (const double u : {1e-3, 0.3, 0.5, 0.8, 0.999})
    ASSERT_LT((piece.gradient(u) - field.interpolate(from + u * (to - from)).gradient).norm(), 1e-6)
        << from.transpose() << " to " << to.transpose();
  const Vector3d first = field.interpolate(from + 1e-6 * (to - from)).gradient;
  const Vector3d last = field.interpolate(to + 1e-6 * (from - to)).gradient;
  ASSERT_LT((piece.gradient_first - first).norm(), 1e-5) << from.transpose();
  ASSERT_LT((piece.gradient_last - last).norm(), 1e-5) << to.transpose();
}

TEST(SmoothPiece, IsTheFieldAlongShortWays) {
  for (const DistanceField& field : fields()) {
    CellReader cells(field);
    SmoothPieceReader reader(field, cells);
    SmoothPiece piece;
    Random random(1);
    int smooth = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vector3d from = uniformIn(random, {-kHalf, kHalf});
      const Vector3d to = (from + 0.003 * direction(random)).cwiseMax(-kHalf).cwiseMin(kHalf);
      if (!reader.readWay(from, to, piece)) continue;
      ++smooth;
      expectThatOf(field, from, to, piece);
    }
    EXPECT_GT(smooth, 1000);
  }
}

TEST(SmoothPiece, IsTheFieldBetweenBreaks) {
  for (const DistanceField& field : fields()) {
    CellReader cells(field);
    SmoothPieceReader reader(field, cells);
    SmoothPiece piece;
    Random random(2);
    int smooth = 0;
    std::vector<double> breaks;
    for (int i = 0; i < 500; ++i) {
      const Segment way{uniformIn(random, {-kHalf, kHalf}), uniformIn(random, {-kHalf, kHalf})};
      smoothPieces(field, way, {0.0, 1.0}, breaks);
      breaks.insert(breaks.begin(), 0.0);
      breaks.push_back(1.0);
      for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
        if (breaks[k + 1] - breaks[k] < 1e-3) continue;  // too short to tell which cell a point near its end is in
        const auto at = [&](double t) -> Vector3d { return way.start + t * (way.end - way.start); };
        if (!reader.readPiece(at(breaks[k]), at(breaks[k + 1]), piece)) continue;
        ++smooth;
        expectThatOf(field, at(breaks[k]), at(breaks[k + 1]), piece);
      }
    }
    EXPECT_GE(smooth, 500);
  }
}

/// A way that turns from one face of a box to another is two pieces, and round bodies have none.
TEST(SmoothPiece, IsNotMoreThanOne) {
  const auto isSmooth = [](const DistanceField& field, const Vector3d& from, const Vector3d& to) {
    CellReader cells(field);
    SmoothPiece piece;
    return SmoothPieceReader(field, cells).readWay(from, to, piece);
  };
  const DistanceField box(Primitive(Box::fromSize(2.0 * kHalf)));
  EXPECT_TRUE(isSmooth(box, {0.0, 0.0, 0.09}, {0.1, 0.0, 0.09}));
  EXPECT_FALSE(isSmooth(box, {0.0, 0.0, 0.09}, {0.0, 0.0, -0.09}));
  EXPECT_FALSE(isSmooth(box, {0.0, 0.0, 0.09}, {0.295, 0.0, 0.09}));
  EXPECT_FALSE(isSmooth(DistanceField(Primitive(Sphere{0.1})), {0.0, 0.0, 0.05}, {0.0, 0.0, 0.06}));
  FieldOptions uniform;
  uniform.cells = 40;
  const DistanceField grid = buildField(boxMesh(kHalf), uniform);
  EXPECT_FALSE(isSmooth(grid, {0.0, 0.0, 0.09}, {0.05, 0.0, 0.09}));
}

}  // namespace sdf_ccd::smooth_piece_test
