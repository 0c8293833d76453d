#include "contact/cell_paths.h"

#include <cmath>

#include <gtest/gtest.h>

#include "contact/curved_field.h"
#include "field/field_access.h"
#include "oracle/contact_case.h"
#include "oracle/random.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::cell_paths_test {

using namespace test;
using Real = long double;
using Vector3l = Eigen::Matrix<Real, 3, 1>;

/// The point and the path of one lane.
struct Path {
  std::array<double, 8> corners;
  Vector3d from, to;  // in the cell
  double side;
  Vector3d start, step;
  double stiffness, damping;

  Real weight(int corner, const Vector3l& u) const {
    Real product = 1.0L;
    for (int k = 0; k < 3; ++k) product *= corner >> k & 1 ? u[k] : 1.0L - u[k];
    return product;
  }
  Vector3l at(Real s) const { return from.cast<Real>() + s * (to - from).cast<Real>(); }
  Real value(Real s) const {
    Real sum = 0.0L;
    for (int c = 0; c < 8; ++c) sum += corners[c] * weight(c, at(s));
    return sum;
  }
  Vector3l normal(Real s) const {
    Vector3l gradient;
    for (int k = 0; k < 3; ++k) {
      // Linear along each axis: a difference is exact.
      Vector3l low = at(s), high = low;
      low[k] = 0.0L;
      high[k] = 1.0L;
      gradient[k] = 0.0L;
      for (int c = 0; c < 8; ++c) gradient[k] += corners[c] * (weight(c, high) - weight(c, low));
    }
    return gradient.normalized();
  }
};

void put(const Path& path, int lane, CellPaths& paths) {
  for (int c = 0; c < 8; ++c) paths.corners[c][lane] = path.corners[c];
  for (int k = 0; k < 3; ++k) {
    paths.from[k][lane] = path.from[k];
    paths.to[k][lane] = path.to[k];
    paths.start[k][lane] = path.start[k];
    paths.step[k][lane] = path.step[k];
  }
  paths.side[lane] = path.side;
  paths.stiffness[lane] = path.stiffness;
  paths.damping[lane] = path.damping;
}

/// In a cell below zero, which bends; some paths have their deepest place on the path.
Path randomPath(Random& random, double far) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Path path;
  path.side = std::pow(10.0, -4.0 * u(random));
  for (double& corner : path.corners) corner = -path.side * (0.01 + u(random));
  path.from = uniformIn(random, {Vector3d::Zero(), Vector3d::Ones()});
  path.to = uniformIn(random, {Vector3d::Zero(), Vector3d::Ones()});
  path.start = Vector3d(far, 0.5 * far, 0.0) + uniformIn(random, {-Vector3d::Ones(), Vector3d::Ones()});
  path.step = path.side * (path.to - path.from);
  path.stiffness = std::pow(10.0, 9.0 * u(random));
  path.damping = u(random) < 0.5 ? 0.0 : u(random) * path.stiffness;
  return path;
}

TEST(CellPaths, BearWhatGausssRuleSays) {
  Random random(3);
  for (const double far : {0.0, 1e3}) {
    for (int trial = 0; trial < 100; ++trial) {
      constexpr double kDuration = 1e-3;
      CellPaths paths;
      std::vector<Path> used;
      CellImpulses impulses;
      CellDepths deepest;
      Vector3l impulse = Vector3l::Zero(), angular = Vector3l::Zero();
      Real size = 0.0L;
      for (int group = 0; group < 1 + trial % 3; ++group) {
        paths = {};
        used.clear();
        for (int lane = 0; lane < 1 + trial % CellPaths::kCount; ++lane) {
          used.push_back(randomPath(random, far));
          put(used.back(), lane, paths);
        }
        impulses.add(paths, kDuration, deepest);
        for (std::size_t lane = 0; lane < used.size(); ++lane) {
          const Path& path = used[lane];
          ASSERT_EQ(deepest.bears[lane], 1.0);
          for (const Real from_middle : {-1.0L, 0.0L, 1.0L}) {
            const Real s = 0.5L + from_middle * std::sqrt(0.15L), weight = (from_middle == 0.0L ? 8.0L : 5.0L) / 18.0L;
            const Vector3l force = -Real(path.stiffness) * path.value(s) * path.normal(s) -
                                   Real(path.damping) * path.step.cast<Real>() / kDuration;
            const Vector3l part = weight * kDuration * force;
            impulse += part;
            angular += (path.start.cast<Real>() + s * path.step.cast<Real>()).cross(part);
            size += part.norm();
          }
          Real least = 0.0L;
          for (int i = 0; i <= 1000; ++i) least = std::min(least, path.value(i / 1000.0L));
          const Real at = deepest.u[lane];
          EXPECT_LE(std::abs(double(path.value(at)) - deepest.value[lane]), 1e-14 * path.side);
          EXPECT_LE(deepest.value[lane], double(least) + 1e-14 * path.side);
          if (at != 0.0L && at != 1.0L) continue;
          const Vector3d normal(deepest.normal[0][lane], deepest.normal[1][lane], deepest.normal[2][lane]);
          EXPECT_LE((normal - path.normal(at).cast<double>()).norm(), 1e-12);
        }
      }
      Wrench sum;
      ChordImpulses all(sum);
      all.begin({});
      impulses.moveTo(all);
      all.finish();
      EXPECT_LE((sum.force - impulse.cast<double>()).norm(), 1e-13 * double(size));
      EXPECT_LE((sum.torque - angular.cast<double>()).norm(), 1e-13 * (1.0 + far) * double(size));
    }
  }
}

/// Nothing is added for a cell without a direction; the lanes beside it are as without it.
TEST(CellPaths, WithoutDirectionBearNothing) {
  Random random(4);
  const Path path = randomPath(random, 0.0);
  Path flat = path;
  flat.corners.fill(-0.01);
  CellPaths both, one;
  put(flat, 0, both);
  put(path, 1, both);
  put(path, 1, one);
  std::array<Wrench, 2> sums;
  for (int i = 0; i < 2; ++i) {
    CellImpulses impulses;
    CellDepths deepest;
    impulses.add(i == 0 ? both : one, 1.0, deepest);
    EXPECT_EQ(deepest.bears[0], 0.0);
    EXPECT_EQ(deepest.bears[1], 1.0);
    ChordImpulses all(sums[i]);
    all.begin({});
    impulses.moveTo(all);
    all.finish();
  }
  EXPECT_GT(sums[0].force.norm(), 0.0);
  EXPECT_LE((sums[0].force - sums[1].force).norm(), 1e-15 * sums[1].force.norm());
  EXPECT_LE((sums[0].torque - sums[1].torque).norm(), 1e-14 * (sums[1].torque.norm() + sums[1].force.norm()));
}

/// What a contact bears if no point counts as in contact all along, so that each is integrated by itself.
ContactImpulse oneByOne(const ContactCase& contact, const ContactOptions& options) {
  std::vector<ShellHit> hits = contact.hits();
  for (ShellHit& hit : hits) hit.interval.exit = std::min(hit.interval.exit, std::nextafter(1.0, 0.0));
  ContactImpulse found;
  integrateContact({contact.field, contact.shell, contact.path, contact.X_CF, contact.siblings}, hits, options, {},
                   found);
  return found;
}

/// Points of one contact are added together where their paths allow: each bears what it does by itself, and has its
/// depth. Some points are inside only for a part of the time, some change the cell, some are on the faces of cells.
TEST(CellPaths, PointsTogetherAreAsEachByItself) {
  Random random(5);
  FieldOptions adaptive;
  adaptive.max_error = 2e-3;
  const std::vector<DistanceField> fields = {curvedField(), buildField(boxMesh({0.3, 0.3, 0.3}), adaptive)};
  ASSERT_TRUE(FieldAccess::grid(fields[0]) && FieldAccess::adaptive(fields[1]));
  ContactOptions options = perArea();
  options.damping = 3.0;
  for (const DistanceField& field : fields) {
    for (int trial = 0; trial < 200; ++trial) {
      ContactCase all{field, {}, oneChord(0.1, translation({0, 0, -0.01}), translation({1e-4, 2e-4, -0.0101}))};
      if (trial % 2)
        all.path = oneChord(0.1, pose({0, 0, -0.01}, 0.1, {1, 2, 3}), pose({0.01, 0.02, -0.02}, 0.12, {1, 2, 3}));
      all.X_CF = {pose({0.1, 0.2, 0.3}, 0.4, {3, 2, 1}), pose({0.1, 0.25, 0.3}, 0.45, {3, 2, 1})};
      for (int i = 0; i < 1 + trial % 11; ++i) {
        Vector3d p = uniformIn(random, {Vector3d(-0.2, -0.2, -0.2), Vector3d(0.2, 0.2, 0.05)});
        if (trial % 4 == 0) p[i % 3] = 0.1 * std::round(10.0 * p[i % 3]);
        all.shell.add(p, -Vector3d::UnitZ(), 0.1F);
      }
      const ContactImpulse together = all.run(options), expected = oneByOne(all, options);
      ASSERT_EQ(together.depths.size(), expected.depths.size());
      for (std::size_t i = 0; i < expected.depths.size(); ++i) {
        const HitDepth &one = together.depths[i], &other = expected.depths[i];
        // In an adaptive field, rounding decides on which side of a jump a point on a face is.
        const double jump = FieldAccess::adaptive(field) ? 2.0 * field.errorBound() : 0.0;
        EXPECT_NEAR(one.depth, other.depth, 1e-14 + jump);
        EXPECT_LE(std::abs(one.depth - other.depth), one.error + other.error);
        if (one.time != other.time) continue;
        EXPECT_LE((one.p_C - other.p_C).norm(), 1e-12);
      }
      const double size = expected.on_shell_body.force.norm();
      const double share = FieldAccess::adaptive(field) ? 1e-2 : 1e-9;
      EXPECT_LE((together.on_shell_body.force - expected.on_shell_body.force).norm(), share * size);
      EXPECT_LE((together.on_shell_body.torque - expected.on_shell_body.torque).norm(), share * size);
    }
  }
}

}  // namespace sdf_ccd::cell_paths_test
