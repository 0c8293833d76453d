#include <gtest/gtest.h>

#include "oracle/rounds.h"
#include "sdf_ccd/primitive.h"
#include "surface/separation_case.h"

namespace sdf_ccd::separation_bound_test {

using test::drawSeparation;
using test::Random;
using test::Real;
using test::treeOf;
using Case = test::SeparationCase;
using Shapes = test::SeparationShapes;

/// For random motions, fast and slow, far and near: no lower bound exceeds the distance, and every crossing is real.
TEST(Separation, BoundsAndCrossingsAreTrue) {
  const Shapes shapes;
  Random random(1);
  SeparationMemory memory;
  long apart = 0, crossing = 0, open = 0;
  std::vector<double> ratios;  // of the bound to the distance found
  for (int trial = 0; trial < test::rounds(250); ++trial) {
    const double travel = std::pow(10.0, test::uniform(random, -4, -0.3));
    const Case c =
        drawSeparation(shapes, random, travel, 3 * travel, std::pow(10.0, test::uniform(random, -4.5, -0.7)));
    SeparationOptions options;
    options.margin = trial % 3 ? 0.0 : 1e-4;
    SeparationWitness witness;
    for (int again = 0; again < 2; ++again) {  // the second time with the witness of the first
      const Separation found = c.query(options, witness, memory);
      if (found.state == SeparationState::kApart) {
        const Real truth = c.leastFound();
        ASSERT_LE(found.distance, truth + 1e-13L) << trial;
        ASSERT_GE(found.distance, options.margin);
        ++apart;
        if (travel < 1e-3 && again) ratios.push_back(found.distance / double(truth));
      } else if (found.state == SeparationState::kCrossing) {
        ++crossing;
        ASSERT_EQ(c.distanceAt(found.s), 0.0L) << trial;
      } else {
        ++open;
        EXPECT_LT(c.leastFound(), options.margin + 2 * options.resolution) << trial;
      }
    }
  }
  EXPECT_GT(apart, test::rounds(120));
  EXPECT_GT(crossing, test::rounds(40));
  EXPECT_LT(open, test::rounds(40));
  std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
  EXPECT_GT(ratios[ratios.size() / 2], 0.55) << "of slow motions the bound is near the distance";
}

/// Climbs from cases that are apart to the largest excess of the bound over the distance: it is never positive.
TEST(Separation, NoClimbFindsABoundAboveTheTruth) {
  const Shapes shapes;
  SeparationMemory memory;
  Random random(7);
  double worst = -1e300;
  for (int start = 0; start < 8; ++start) {
    const double travel = std::pow(10.0, test::uniform(random, -3, -0.5));
    Case best = drawSeparation(shapes, random, travel, 5 * travel, travel * test::uniform(random, 0.01, 0.5));
    const auto excess = [&](const Case& c) {
      SeparationWitness witness;
      const Separation found = c.query({}, witness, memory);
      if (found.state == SeparationState::kCrossing) {
        EXPECT_EQ(c.distanceAt(found.s), 0.0L);
        return -1e300;
      }
      if (found.state != SeparationState::kApart) return -1e300;
      const double truth = double(c.leastFound(12));
      return (found.distance - truth) / (truth + 1e-9);
    };
    double highest = excess(best);
    double step = 0.3;
    for (int i = 0; i < 50; ++i) {
      Case next = best;
      for (Isometry3d* X : {&next.A_start, &next.A_end, &next.B_start, &next.B_end}) {
        X->linear() =
            Eigen::AngleAxisd(step * travel * 5 * test::uniform(random, -1, 1), test::direction(random)) * X->linear();
        X->translation() += step * travel * test::uniform(random, 0, 1) * test::direction(random);
      }
      const double value = excess(next);
      if (value > highest) {
        highest = value;
        best = next;
      } else {
        step = std::max(0.9 * step, 1e-3);
      }
    }
    worst = std::max(worst, highest);
  }
  EXPECT_LE(worst, 1e-9);
  EXPECT_GT(worst, -0.2) << "the climb comes near the truth";
}

/// Bounds of surfaces of many triangles, which long searches and planes between hulls prove.
TEST(Separation, BoundsOfDenseSurfacesAreTrue) {
  Shapes shapes;
  shapes.trees.clear();
  shapes.trees.push_back(treeOf(test::torusMesh(0.1, 0.03, 20, 10)));
  shapes.trees.push_back(treeOf(test::icosphere(0.08, 2)));
  shapes.trees.push_back(treeOf(tessellate(Cylinder::fromRadiusAndLength(0.05, 0.02), 1e-4)));
  shapes.trees.push_back(treeOf(merged(tessellate(Cylinder::fromRadiusAndLength(0.05, 0.02), 1e-3),
                                       test::translated(test::boxMesh({0.01, 0.02, 0.06}), {0.07, 0, 0.03})),
                                2e-3));
  Random random(11);
  SeparationMemory memory;
  long apart = 0, long_searches = 0;
  for (int trial = 0; trial < test::rounds(120); ++trial) {
    const double turn = std::pow(10.0, test::uniform(random, -2.5, 0.2));
    const Case c = drawSeparation(shapes, random, 0.03 * turn, turn, std::pow(10.0, test::uniform(random, -4, -2)));
    SeparationWitness witness;
    const Separation found = c.query({}, witness, memory);
    long_searches += found.tests > 64;
    if (found.state == SeparationState::kCrossing) {
      ASSERT_EQ(c.distanceAt(found.s), 0.0L) << trial;
    } else if (found.state == SeparationState::kApart) {
      ++apart;
      ASSERT_LE(found.distance, c.leastFound() + 1e-13L) << trial;
    }
  }
  EXPECT_GT(apart, test::rounds(20));
  EXPECT_GT(long_searches, test::rounds(30));
}

}  // namespace sdf_ccd::separation_bound_test
