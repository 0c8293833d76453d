#include <gtest/gtest.h>

#include <algorithm>

#include "monitor/join_results.h"
#include "oracle/scene_case.h"

namespace sdf_ccd::deep_contact_test {

using namespace test;

/// A small box goes straight through a ball, much deeper than the field's band: where it is deepest is not known there.
TEST(Monitor, DepthsBeyondTheBandHaveAnErrorThatHolds) {
  int deeper = 0;
  for (const double radius : {0.05, 0.1, 0.2, 0.5}) {
    for (const int pieces : {1, 7}) {
      const auto scene = build(
          {body("ball", meshShape(icosphere(radius, 5))), body("box", Primitive(Box::fromSize({0.04, 0.04, 0.04})))},
          optionsForContacts());
      Monitor monitor(scene, {});
      const auto at = [&](double share) {
        return translation({(4.0 * share - 2.0) * radius, 0.01, 0.02 + 0.005 * share});
      };
      ResultJoiner joiner(50);
      CycleRequest request;
      request.max_points = 50;
      for (int i = 0; i < pieces; ++i) {
        const CycleMotion motion =
            cycle(1.0, {still(Isometry3d::Identity()), {at(double(i) / pieces), at(double(i + 1) / pieces)}});
        joiner.add(motion, monitor.run(motion, request));
      }
      const PairResult pair = joiner.result().pairs[0];
      ASSERT_FALSE(pair.points.empty());
      double greatest = 0.0;  // of any of these points
      for (const ContactPoint& point : pair.points) {
        const Vector3d p_Box = at(point.time / pieces).inverse() * point.p_W;
        double depth = 0.0;  // in the ball, less than the mesh's distance from it
        for (int k = 0; k <= 1000; ++k) {
          const double time = point.enter + k / 1000.0 * (point.exit - point.enter);
          depth = std::max(depth, 0.9995 * radius - (at(time / pieces) * p_Box).norm());
        }
        if (depth < point.depth - point.depth_error) continue;  // it is one of the ball's
        EXPECT_GE(point.depth + point.depth_error + 1e-3, depth) << radius << " in " << pieces;
        deeper += depth > point.depth + 0.01;
        greatest = std::max(greatest, depth);
      }
      EXPECT_GE(pair.deepest.depth + pair.deepest.depth_error + 1e-3, greatest) << radius << " in " << pieces;
      EXPECT_LE(pair.deepest.depth, radius) << radius << " in " << pieces;
      EXPECT_LT(pair.deepest.depth_error, 2e-4) << radius << " in " << pieces;
    }
  }
  EXPECT_GT(deeper, 0) << "the field tells them all";
}

}  // namespace sdf_ccd::deep_contact_test
