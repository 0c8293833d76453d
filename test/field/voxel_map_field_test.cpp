#include <gtest/gtest.h>

#include "field/voxel_field.h"
#include "oracle/parameter_name.h"
#include "oracle/random.h"
#include "oracle/test_data.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::voxel_map_field_test {

using namespace test;

constexpr double kSize = 0.05;  // side of a voxel [m]
const Vector3d kOrigin(3.0, -2.0, 0.7);

/// Voxels in a box, each occupied or not.
class Voxels {
 public:
  enum Kind { kDust, kWalls, kHollowBall, kNoise, kTwoFarApart };

  Voxels(Random& random, Kind kind, const Vector3i& count) : count_(count), occupied_(std::size_t(count.prod())) {
    for (Vector3i v(0, 0, 0); v.z() < count.z(); ++v.z())
      for (v.y() = 0; v.y() < count.y(); ++v.y())
        for (v.x() = 0; v.x() < count.x(); ++v.x()) {
          const double r = (v.cast<double>() - 0.5 * count.cast<double>()).norm() / double(count.minCoeff());
          const double chance = uniform(random, 0.0, 1.0);
          occupied_[indexOf(v)] = kind == kDust         ? chance < 0.01
                                  : kind == kWalls      ? v.z() == 1 || v.x() == count.x() / 2
                                  : kind == kHollowBall ? r < 0.48 && r > 0.2
                                  : kind == kNoise      ? chance < 0.5
                                                        : v.sum() == 0 || v == Vector3i(count.array() - 1);
        }
  }

  bool isIn(const Vector3i& v) const {
    return v.minCoeff() >= 0 && (count_ - v).minCoeff() > 0 && occupied_[indexOf(v)];
  }

  /// A square for each face between an occupied and a free voxel, with vertices of its own.
  TriangleMesh boundary() const {
    TriangleMesh mesh;
    each([&](const Vector3i& v) {
      if (!isIn(v)) return;
      for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1}) {
          const Vector3i unit = Vector3i::Unit(axis), u = Vector3i::Unit((axis + 1) % 3),
                         w = Vector3i::Unit((axis + 2) % 3);
          if (isIn(v + (2 * side - 1) * unit)) continue;
          const Vector3i low = v + side * unit;
          const int first = int(mesh.vertices.size());
          for (const Vector3i& corner : {low, Vector3i(low + u), Vector3i(low + u + w), Vector3i(low + w)})
            mesh.vertices.push_back(kOrigin + kSize * corner.cast<double>());
          if (side == 1) {
            mesh.triangles.emplace_back(first, first + 1, first + 2);
            mesh.triangles.emplace_back(first, first + 2, first + 3);
          } else {
            mesh.triangles.emplace_back(first, first + 2, first + 1);
            mesh.triangles.emplace_back(first, first + 3, first + 2);
          }
        }
    });
    return mesh;
  }

  /// By brute force over all voxels.
  double distance(const Vector3d& p) const {
    const double out = distanceTo(true, p);
    return out > 0.0 ? out : -distanceTo(false, p);
  }

 private:
  std::size_t indexOf(const Vector3i& v) const {
    return std::size_t((v.z() * count_.y() + v.y()) * count_.x() + v.x());
  }

  template <class Visit>
  void each(const Visit& visit, int ring = 0) const {
    for (Vector3i v = Vector3i::Constant(-ring); v.z() < count_.z() + ring; ++v.z())
      for (v.y() = -ring; v.y() < count_.y() + ring; ++v.y())
        for (v.x() = -ring; v.x() < count_.x() + ring; ++v.x()) visit(v);
  }

  double distanceTo(bool occupied, const Vector3d& p) const {
    double least = 1e9;
    each(
        [&](const Vector3i& v) {
          if (isIn(v) != occupied) return;
          const Vector3d low = kOrigin + kSize * v.cast<double>();
          least = std::min(least, AlignedBox3d(low, low + Vector3d::Constant(kSize)).exteriorDistance(p));
        },
        1);
    return least;
  }

  Vector3i count_;
  std::vector<bool> occupied_;
};

FieldOptions withCell(double cell, double band) {
  FieldOptions options;
  options.max_error.reset();
  options.cells.reset();
  options.cell_size = cell;
  options.band = band;
  return options;
}

TEST(VoxelSolid, IsToldFromItsBoundary) {
  Random random(3);
  for (const auto kind : {Voxels::kDust, Voxels::kWalls, Voxels::kHollowBall, Voxels::kNoise}) {
    // Rows of one voxel, of less than a word, of exactly one word, and of more.
    for (const int x : {1, 20, 64, 70}) {
      const Voxels voxels(random, kind, {x, 7, 9});
      const TriangleMesh mesh = voxels.boundary();
      if (mesh.triangles.empty()) continue;
      const auto solid = VoxelSolid::of(mesh);
      ASSERT_TRUE(solid) << kind << " " << x;
      EXPECT_NEAR(solid->size(), kSize, 1e-12);
      const Vector3i low = ((solid->origin() - kOrigin) / kSize).array().round().cast<int>();
      for (Vector3i v(-1, -1, -1); v.z() < 11; ++v.z())
        for (v.y() = -1; v.y() < 9; ++v.y()) {
          std::vector<VoxelSolid::Run> runs;
          solid->runs(v.y(), v.z(), runs);
          for (v.x() = -1; v.x() < x + 2; ++v.x()) {
            EXPECT_EQ(solid->isIn(v.x(), v.y(), v.z()), voxels.isIn(v + low));
            const bool is_in_run = std::any_of(runs.begin(), runs.end(), [&](const VoxelSolid::Run& run) {
              return run.begin <= v.x() && v.x() < run.end;
            });
            EXPECT_EQ(is_in_run, voxels.isIn(v + low));
          }
        }
    }
  }
}

TEST(VoxelSolid, NoOtherMeshIsTakenForVoxels) {
  Random random(4);
  const TriangleMesh voxels = Voxels(random, Voxels::kWalls, {12, 9, 7}).boundary();
  ASSERT_TRUE(VoxelSolid::of(voxels));
  EXPECT_FALSE(VoxelSolid::of(voxels, 100));  // too many
  EXPECT_FALSE(VoxelSolid::of(TriangleMesh()));
  TriangleMesh open = voxels;
  open.triangles.pop_back();
  EXPECT_FALSE(VoxelSolid::of(open));
  TriangleMesh twice = voxels;
  twice.triangles.insert(twice.triangles.end(), voxels.triangles.begin(), voxels.triangles.begin() + 2);
  EXPECT_FALSE(VoxelSolid::of(twice));
  TriangleMesh moved = voxels;
  moved.vertices[5] += Vector3d(0.0, 0.1 * kSize, 0.0);
  EXPECT_FALSE(VoxelSolid::of(moved));
  TriangleMesh endless = voxels;
  endless.vertices[5].x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(VoxelSolid::of(endless));
  TriangleMesh point = voxels;
  for (Vector3d& vertex : point.vertices) vertex.setZero();
  EXPECT_FALSE(VoxelSolid::of(point));
}

/// The parameter is the number of cells per voxel.
class VoxelMapField : public ::testing::TestWithParam<int> {};

TEST_P(VoxelMapField, IsExactAtTheLatticeAndOffByNoMoreThanItSays) {
  Random random(5);
  const double cell = kSize / GetParam(), band = 3.3 * cell;
  for (const auto kind : {Voxels::kDust, Voxels::kWalls, Voxels::kHollowBall, Voxels::kNoise, Voxels::kTwoFarApart}) {
    const Vector3i count(70 / GetParam(), 23, 17);
    const Voxels voxels(random, kind, count);
    const auto solid = VoxelSolid::of(voxels.boundary());
    ASSERT_TRUE(solid);
    const FieldOptions options = withCell(cell, band);
    ASSERT_TRUE(canBeLattice(*solid, options));
    const DistanceField field = buildField(*solid, options);
    int near = 0, inside = 0;
    for (int i = 0; i < 600; ++i) {
      Vector3d p;
      for (int k = 0; k < 3; ++k) {
        const double end = kind == Voxels::kTwoFarApart && i % 3 == 0 ? 4.0 : count[k] + 4.0;
        p[k] = kOrigin[k] + kSize * uniform(random, -4.0, end);
      }
      if (i % 2 == 0) p = kOrigin + cell * ((p - kOrigin) / cell).array().round().matrix();
      const double truth = voxels.distance(p);
      const FieldSample found = field.sample(p);
      EXPECT_LE(std::abs(found.value - truth), found.error + 1e-9) << p.transpose();
      if (std::abs(truth) > band) continue;
      ++near;
      inside += truth < 0.0;
      EXPECT_LE(found.error, field.errorBound() + 1e-9);
      if (i % 2 == 0) {
        EXPECT_NEAR(found.value, truth, 1e-3 * cell) << p.transpose();
      }
    }
    EXPECT_GT(near, kind == Voxels::kTwoFarApart ? 3 : 20) << kind;
    if (kind == Voxels::kHollowBall || kind == Voxels::kNoise) {
      EXPECT_GT(inside, 20);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(CellsPerVoxel, VoxelMapField, ::testing::Values(1, 2, 3), test::ParameterName());

TEST(VoxelMapField, OtherCellsAreNotOfALattice) {
  Random random(6);
  const auto solid = VoxelSolid::of(Voxels(random, Voxels::kWalls, {9, 9, 9}).boundary());
  EXPECT_FALSE(canBeLattice(*solid, FieldOptions()));
  EXPECT_FALSE(canBeLattice(*solid, withCell(0.4 * kSize, 0.0)));
  EXPECT_FALSE(canBeLattice(*solid, withCell(3.0 * kSize, 0.0)));
  EXPECT_FALSE(canBeLattice(*solid, withCell(0.5 * kSize, 100.0 * kSize)));
}

TEST(VoxelMapField, TooManyBytesAreRefused) {
  Random random(7);
  const auto solid = VoxelSolid::of(Voxels(random, Voxels::kNoise, {40, 40, 40}).boundary());
  FieldOptions options = withCell(0.5 * kSize, 0.0);
  options.max_bytes = 100000;
  EXPECT_THROW(buildField(*solid, options), std::length_error);
  options.max_bytes = 1000;
  EXPECT_THROW(buildField(*solid, options), std::length_error);
}

/// A cell that differs from an exact part of the voxels' side by what is accepted: over a long map that adds up.
TEST(VoxelMapField, CellsThatNearlyDivideTheVoxelsAreFittedToThem) {
  const Vector3i count(1500, 2, 2);
  Random random(3);
  Voxels row(random, Voxels::kWalls, count);  // its top layer is full
  const TriangleMesh mesh = row.boundary();
  const std::shared_ptr<const VoxelSolid> solid = VoxelSolid::of(mesh);
  ASSERT_TRUE(solid);
  FieldOptions options;
  options.max_error.reset();
  options.cells.reset();
  options.cell_size = 0.5 * kSize * (1.0 + 0.9e-6);
  ASSERT_TRUE(canBeLattice(*solid, options));
  const DistanceField field = buildField(*solid, options);
  const double end = kOrigin.x() + kSize * count.x();
  for (const double away : {-0.3, -0.1, 0.1, 0.3}) {
    const Vector3d p(end + away * kSize, kOrigin.y() + kSize, kOrigin.z() + 1.5 * kSize);
    const FieldSample sample = field.sample(p);
    EXPECT_LE(std::abs(sample.value - away * kSize), sample.error + 1e-12) << away;
  }
}

}  // namespace sdf_ccd::voxel_map_field_test
