#include "surface/plane_separation.h"

#include <chrono>

#include <gtest/gtest.h>

#include "oracle/least_value.h"
#include "oracle/long_screw.h"
#include "oracle/random.h"
#include "oracle/rounded_triangles.h"
#include "oracle/shapes.h"

namespace sdf_ccd::plane_separation_test {

using test::LongPose;
using test::LongScrew;
using test::Random;
using test::Real;
using test::treeOf;
using test::uniform;
using test::Vector3l;

/// A surface above a half-space, both of which move; heights in long double.
struct Case {
  const BoxTree* surface;
  HalfSpace half_space;
  Isometry3d F_start, F_end, P_start, P_end;

  Separation query(const SeparationOptions& options, SeparationWitness& witness, SeparationMemory& memory) const {
    const ScrewMotion X_WF(F_start, F_end), X_WP(P_start, P_end);
    const WorldTwist twist_f = worldTwist(X_WF, {}), twist_p = worldTwist(X_WP, surface->ball());
    const TwoBodyMotion motion{0.0, 1.0, X_WF, X_WP, relativeMotionBounds(twist_f, twist_p).acceleration};
    return planeSeparation(half_space, *surface, motion, options, witness, memory);
  }
  Separation query(const SeparationOptions& options = {}) const {
    SeparationWitness witness;
    SeparationMemory memory;
    return query(options, witness, memory);
  }

  LongPose relative(Real s) const {
    const LongPose X_WF = LongScrew(F_start, F_end).pose(s), X_WP = LongScrew(P_start, P_end).pose(s);
    return {X_WF.R.transpose() * X_WP.R, X_WF.R.transpose() * (X_WP.p - X_WF.p)};
  }

  Real heightAt(Real s) const {
    const LongPose X = relative(s);
    const Vector3l n = half_space.normal.cast<Real>(), m = X.R.transpose() * n;
    const Real offset = n.dot(X.p) - Real(half_space.offset);
    Real least = std::numeric_limits<Real>::infinity();
    for (int i = 0; i < int(surface->size()); ++i)
      for (const Vector3d& p : surface->triangle(i).corners)
        least = std::min(least, m.dot(p.cast<Real>()) + offset - Real(surface->triangle(i).radius));
    return least;
  }

  /// The smallest height found at some times, and by a local search from the best of them: an upper bound.
  Real leastFound(int samples) const {
    return test::leastFound([&](Real s, Real) { return heightAt(s); }, samples, 1e-7L);
  }
};

std::vector<BoxTree> shapes() {
  std::vector<BoxTree> trees;
  trees.push_back(treeOf(test::boxMesh({0.1, 0.06, 0.02})));
  trees.push_back(treeOf(test::torusMesh(0.1, 0.03, 8, 5)));
  trees.push_back(treeOf(test::translated(test::boxMesh({0.2, 0.001, 0.03}), {0.3, 0, 0})));
  trees.push_back(treeOf(test::icosphere(0.2, 2)));
  trees.push_back(BoxTree({{{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}, 0.05}}));            // a ball
  trees.push_back(BoxTree({{{Vector3d(-0.3, 0, 0), Vector3d(0.2, 0, 0), Vector3d(0.2, 0, 0)}, 0.02}}));  // a capsule
  trees.push_back(treeOf(test::boxMesh({0.05, 0.05, 0.05}), 0.01));
  return trees;
}

/// Draws a motion in which the surface's lowest height is about `gap`.
Case draw(Random& random, const BoxTree& surface, double gap, int samples) {
  const double size = std::pow(10.0, uniform(random, -3.0, 1.0));
  const bool rests = random() % 2 == 0;
  Case drawn{&surface, {test::direction(random), uniform(random, -1.0, 1.0)}, {}, {}, {}, {}};
  drawn.F_start = test::pose(random, 3.1, 2.0);
  drawn.F_end = rests ? drawn.F_start : Isometry3d(drawn.F_start * test::pose(random, std::min(2.0, size), size));
  drawn.P_start = test::pose(random, 3.1, 2.0);
  drawn.P_end = drawn.P_start * test::pose(random, std::min(3.0, size), size);
  drawn.half_space.offset += static_cast<double>(drawn.leastFound(samples)) - gap;
  return drawn;
}

/// Every state is true, and what is farther from the plane than the resolution is decided.
TEST(PlaneSeparation, IsTrueAndDecides) {
  Random random(1);
  int apart = 0, crossing = 0, open = 0;
  for (const BoxTree& surface : shapes()) {
    for (int trial = 0; trial < 100; ++trial) {
      const double gap = (trial % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, uniform(random, -8.0, -2.0));
      SeparationOptions options;
      options.margin = trial % 3 == 0 ? 1e-3 : 0.0;
      const Case drawn = draw(random, surface, gap, 200);
      const Real least = drawn.leastFound(1000);
      const Separation found = drawn.query(options);
      if (found.state == SeparationState::kApart) {
        ASSERT_GT(least, options.margin);
        ASSERT_LE(found.distance, least);
        ++apart;
      } else if (found.state == SeparationState::kCrossing) {
        ASSERT_LT(drawn.heightAt(found.s), -options.margin);
        ASSERT_NEAR(drawn.half_space.normal.dot(found.p_A) - drawn.half_space.offset,
                    static_cast<double>(drawn.heightAt(found.s)), 2e-6);
        ASSERT_EQ(found.normal_A, drawn.half_space.normal);
        ++crossing;
      } else {
        ASSERT_LE(found.open_within, 1.1 * options.resolution);
        ASSERT_LE(std::abs(static_cast<double>(least)), options.margin + found.open_within);
        ++open;
      }
      if (std::abs(static_cast<double>(least)) > options.margin + 1.1 * options.resolution) {
        ASSERT_NE(found.state, SeparationState::kOpen) << static_cast<double>(least);
      }
    }
  }
  EXPECT_GT(apart, 150);
  EXPECT_GT(crossing, 150);
  EXPECT_GT(open, 30);
}

/// Answers do not depend on where the search starts.
TEST(PlaneSeparation, AnyWitnessWillDo) {
  Random random(2);
  const BoxTree surface = treeOf(test::icosphere(0.2, 2));
  SeparationMemory memory;
  for (int trial = 0; trial < 300; ++trial) {
    const Case drawn = draw(random, surface, uniform(random, -1e-2, 1e-2), 50);
    SeparationWitness witness;
    witness.near_b = static_cast<int>(random() % surface.size());
    EXPECT_EQ(drawn.query({}, witness, memory).state, drawn.query().state);
  }
}

TEST(LowestPoint, IsTheLowestCorner) {
  Random random(3);
  SeparationMemory memory;
  for (const BoxTree& surface : shapes()) {
    SeparationWitness witness;
    for (int trial = 0; trial < 300; ++trial) {
      const Isometry3d X_FP = test::pose(random, 3.1, 2.0);
      const Case at{&surface, {test::direction(random), 0.3}, Isometry3d::Identity(), Isometry3d::Identity(), X_FP,
                    X_FP};
      const double accuracy = std::pow(10.0, uniform(random, -9.0, -2.0)), truth = static_cast<double>(at.heightAt(0));
      const LowestPoint lowest = lowestPoint(at.half_space, surface, X_FP, accuracy, witness, memory);
      EXPECT_GE(lowest.height, truth - 1e-14);
      EXPECT_LE(lowest.height, truth + accuracy + 1e-14);
      EXPECT_LE(lowest.at_least, truth + 1e-14);
      EXPECT_GE(lowest.at_least, lowest.height - accuracy - 1e-14);
      EXPECT_NEAR(at.half_space.normal.dot(lowest.p_F) - at.half_space.offset, lowest.height, 1e-13);
    }
  }
}

/// A large flat face that lies on the plane costs no more than a few of its boxes, whatever its size and the accuracy.
TEST(LowestPoint, FlatFacesAreNotOpened) {
  Random random(4);
  for (const double side : {1.0, 40.0}) {
    TriangleMesh sheet;
    constexpr int kSide = 150;
    for (int y = 0; y <= kSide; ++y)
      for (int x = 0; x <= kSide; ++x) sheet.vertices.push_back(side / kSide * Vector3d(x, y, 0.0));
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const int i = y * (kSide + 1) + x;
        sheet.triangles.push_back({i, i + 1, i + kSide + 2});
        sheet.triangles.push_back({i, i + kSide + 2, i + kSide + 1});
      }
    const BoxTree surface = treeOf(sheet);
    SeparationWitness witness;
    SeparationMemory memory;
    double search = 1.0, scan = 1.0;  // shortest [s]
    const auto since = [](std::chrono::steady_clock::time_point start) {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    for (int trial = 0; trial < 20; ++trial) {
      const Isometry3d X = test::pose(random, 3.1, 1.0);
      const HalfSpace plane{X.linear().col(2), X.linear().col(2).dot(X.translation()) - 1e-4};
      const auto start = std::chrono::steady_clock::now();
      const LowestPoint lowest = lowestPoint(plane, surface, X, 1e-7, witness, memory);
      search = std::min(search, since(start));
      EXPECT_NEAR(lowest.height, 1e-4, 1e-12);
      EXPECT_NEAR(lowest.at_least, 1e-4, 1e-6 * side);
      const auto between = std::chrono::steady_clock::now();
      double least = 1.0;
      for (int i = 0; i < int(surface.size()); ++i)
        for (const Vector3d& p : surface.triangle(i).corners) least = std::min(least, plane.normal.dot(X * p));
      EXPECT_NEAR(least - plane.offset, 1e-4, 1e-12);
      scan = std::min(scan, since(between));
    }
    EXPECT_LT(search, 0.5 * scan) << side << ": 0.07 at most, unless boxes that lie on the plane are opened";
  }
}

/// A body that circles far out, near the plane for long: the poses tested are limited, and what is left open is said.
TEST(PlaneSeparation, EndsAtItsLimit) {
  const BoxTree surface = treeOf(test::translated(test::icosphere(0.2, 2), {1e5, 0, 0}));
  Case circling{&surface, {Vector3d::UnitZ(), -0.2 - 2e-5}, {}, {}, {}, {}};
  circling.F_start = circling.F_end = circling.P_start = circling.P_end = Isometry3d::Identity();
  circling.P_end.linear() = Eigen::AngleAxisd(3.0, Vector3d::UnitZ()).toRotationMatrix();
  SeparationOptions options;
  for (const int max_tests : {0, 10, 1000}) {
    options.max_tests = max_tests;
    const Separation found = circling.query(options);
    EXPECT_EQ(found.state, SeparationState::kOpen);
    EXPECT_LE(found.tests, max_tests + 30);
    EXPECT_GT(found.open_within, 2e-5);
    EXPECT_LT(found.open_within, 1.2e5);
  }
}

}  // namespace sdf_ccd::plane_separation_test
