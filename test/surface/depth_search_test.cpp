#include "surface/depth_search.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "oracle/box_union.h"
#include "oracle/drawn_meshes.h"
#include "oracle/long_screw.h"
#include "oracle/random.h"
#include "oracle/rounded_triangles.h"
#include "oracle/rounds.h"
#include "oracle/shapes.h"
#include "oracle/triangle_distance.h"

namespace sdf_ccd::depth_search_test {

using test::LongScrew;
using test::Random;
using test::Real;
using test::treeOf;
using test::Vector3r;

/// Exact depths in a closed mesh, by brute force over all triangles.
class MeshTruth {
 public:
  explicit MeshTruth(const TriangleMesh& mesh) {
    for (const Vector3i& t : mesh.triangles)
      triangles_.push_back(
          test::exact(std::array<Vector3d, 3>{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}));
  }

  /// Negative outside.
  Real depth(const Vector3r& p) const {
    Real nearest = 1e300L, angles = 0.0L;
    for (const test::Triangle3r& t : triangles_) {
      nearest = std::min(nearest, test::triangleDistance(t, {p, p, p}));
      const Vector3r a = t[0] - p, b = t[1] - p, c = t[2] - p;
      const Real la = a.norm(), lb = b.norm(), lc = c.norm();
      angles += 2.0L * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
    }
    return std::abs(angles) > 6.0L ? nearest : -nearest;
  }

 private:
  std::vector<test::Triangle3r> triangles_;
};

DepthSolid solidOf(const TriangleMesh& mesh, const Isometry3d& X_BG = Isometry3d::Identity()) {
  return DepthSolid(std::make_shared<Solid>(mesh), X_BG);
}

Vector3r inFrame(const test::LongPose& X_WF, const Vector3r& p_W) {
  return X_WF.R.transpose() * (p_W - X_WF.p);
}

/// The result of a search: the deepest point, and the upper bound of how much deeper another one may be.
struct Found {
  DeepestPoint point;
  double error;
};

Found search(const BoxTree& surface, const DepthSolid& solid, const ScrewMotion& X_WF, const ScrewMotion& X_WP,
             double resolution, int max_pieces = 20000) {
  const RelativeMotionBounds bounds =
      relativeMotionBounds(worldTwist(X_WF, {Vector3d::Zero(), 1.0}), worldTwist(X_WP, surface.ball()));
  const TwoBodyMotion motion{0.0, 1.0, X_WF, X_WP, bounds.acceleration};
  DepthSearch search(surface, solid, resolution);
  search.begin(0.0);
  DeepestPoint best;
  search.run(motion, bounds.travel, best, max_pieces);
  return {best, std::max(0.0, search.highest() - best.depth)};
}

/// Also close to the surface, beside faces, edges and corners, where solids overlap, and where walls are drawn twice.
TEST(DepthSolid, HasTheSideThatTheWindingNumberTells) {
  Random random(3);
  const TriangleMesh box = test::boxMesh({0.05, 0.04, 0.03}), torus = test::torusMesh(0.05, 0.02, 12, 8);
  const TriangleMesh hollow = merged(test::boxMesh({0.08, 0.08, 0.08}), test::flipped(test::icosphere(0.07, 2)));
  for (const TriangleMesh& mesh : {box, torus, test::icosphere(0.05, 2), hollow, test::bowTieMesh(),
                                   merged(box, test::translated(torus, {0.03, 0.01, 0}))}) {
    const auto made = std::make_shared<Solid>(mesh);
    ASSERT_TRUE(made->closed());
    const DepthSolid solid(made, Isometry3d::Identity());
    const MeshTruth truth(made->boundary());
    int sides[2] = {};
    for (int i = 0; i < test::rounds(1000); ++i) {
      const Corners corners =
          cornersOf(made->boundary(), int(random() % made->boundary().triangles.size()));
      double u = test::uniform(random, 0.0, 1.0), v = test::uniform(random, 0.0, 1.0);
      if (i % 4 == 0) u = std::round(u), v = std::round(v);  // corners and a middle
      if (i % 4 == 1) v = 0.0;                               // an edge
      const Vector3d on_surface =
          corners[0] + u * (corners[1] - corners[0]) + v * (1.0 - u) * (corners[2] - corners[0]);
      const Vector3d p = on_surface + std::pow(10.0, test::uniform(random, -7.0, -1.5)) * test::direction(random);
      const Real depth = truth.depth(p.cast<Real>());
      const PointDepth found = solid.at(p);
      ASSERT_NEAR(double(depth), found.depth, 1e-9) << i;
      ++sides[depth > 0.0L];
    }
    EXPECT_GT(std::min(sides[0], sides[1]), test::rounds(250));
  }
}

/// Beside an edge at which two faces meet at a tiny angle, a point is before one of them and behind the other: which
/// one the search for the nearest triangle returns says nothing. In whatever order the triangles are.
TEST(DepthSolid, BesideASharpEdgeIsOutside) {
  constexpr double kLength = 0.2, kWidth = 0.1, kThickness = 4e-6;
  TriangleMesh wedge;
  wedge.vertices = {{0, -kWidth, 0},          {0, kWidth, 0},        {0, -kWidth, -kThickness},
                    {0, kWidth, -kThickness}, {kLength, -kWidth, 0}, {kLength, kWidth, 0}};
  wedge.triangles = {{0, 4, 5}, {0, 5, 1}, {2, 5, 4}, {2, 3, 5}, {0, 2, 4}, {1, 5, 3}, {0, 1, 3}, {0, 3, 2}};
  for (std::size_t order = 0; order < wedge.triangles.size(); ++order) {
    std::rotate(wedge.triangles.begin(), wedge.triangles.begin() + 1, wedge.triangles.end());
    const DepthSolid solid = solidOf(wedge);
    const MeshTruth truth(wedge);
    for (const double height : {-0.03, 0.03}) {
      for (const double y : {0.0, 0.013, 0.05}) {
        for (const double beyond : {-1e-5, 0.0, 1e-9, 1e-4}) {
          const Vector3d p(kLength + beyond, y, height);
          EXPECT_NEAR(solid.at(p).depth, double(truth.depth(p.cast<Real>())), 1e-9)
              << order << ": " << p.transpose();
        }
      }
    }
  }
}

/// The largest depth that random samples of the surface and the motion find, with a local search from the best of them.
Real deepestSample(const TriangleMesh& surface, const MeshTruth& solid, const LongScrew& X_WF, const LongScrew& X_WP,
                   Random& random) {
  struct Place {
    int triangle;
    Real u, v, s;
  };
  const auto depthAt = [&](const Place& place) {
    const Vector3i& t = surface.triangles[place.triangle];
    const Vector3r a = surface.vertices[t[0]].cast<Real>(), b = surface.vertices[t[1]].cast<Real>(),
                   c = surface.vertices[t[2]].cast<Real>();
    const Vector3r p = a + place.u * (b - a) + place.v * (c - a);
    return solid.depth(inFrame(X_WF.pose(place.s), X_WP.pose(place.s) * p));
  };
  const auto valid = [](Place place) {
    place.u = std::clamp<Real>(place.u, 0.0L, 1.0L);
    place.v = std::clamp<Real>(place.v, 0.0L, 1.0L - place.u);
    place.s = std::clamp<Real>(place.s, 0.0L, 1.0L);
    return place;
  };
  Place best{};
  Real most = -1e300L;
  const auto offer = [&](const Place& place) {
    const Real depth = depthAt(place);
    if (!(depth > most)) return false;
    most = depth;
    best = place;
    return true;
  };
  for (int i = 0; i < 500; ++i)
    offer(valid({int(random() % surface.triangles.size()), test::uniform(random, 0.0, 1.0),
                 test::uniform(random, 0.0, 1.0), test::uniform(random, -0.1, 1.1)}));
  Real step = 0.3L;
  for (int i = 0; i < 250; ++i) {
    const int triangle = i % 4 == 3 ? int(random() % surface.triangles.size()) : best.triangle;
    const auto by = [&] { return step * Real(test::uniform(random, -1.0, 1.0)); };
    if (!offer(valid({triangle, best.u + by(), best.v + by(), best.s + by()}))) step = std::max(1e-5L, 0.97L * step);
  }
  return most;
}

TEST(DepthSearch, NoPlaceIsDeeperAndItsOwnDepthIsExact) {
  Random random(7);
  const TriangleMesh box = test::boxMesh({0.05, 0.04, 0.03}), ball = test::icosphere(0.05, 1),
                     torus = test::torusMesh(0.05, 0.02, 12, 8);
  const std::vector<const TriangleMesh*> meshes{&box, &ball, &torus};
  int deep = 0;
  for (const TriangleMesh* inside : meshes) {
    const DepthSolid solid = solidOf(*inside);
    const MeshTruth truth(*inside);
    for (const TriangleMesh* surface : meshes) {
      const BoxTree tree = treeOf(*surface);
      for (int i = 0; i < test::rounds(15); ++i) {
        const double scale = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 0.02 : 1.0;  // at rest, as in a cycle, as in a plan
        const Isometry3d X_WF = test::pose(random, 1.0, 1.0), X_FP = test::pose(random, 2.0, 0.07);
        const ScrewMotion f(X_WF, X_WF * test::pose(random, 1.5 * scale, 0.03 * scale));
        const ScrewMotion p(X_WF * X_FP, X_WF * X_FP * test::pose(random, 1.5 * scale, 0.05 * scale));
        constexpr double kResolution = 5e-5;
        const Found found = search(tree, solid, f, p, kResolution);
        const LongScrew long_f(f.start(), f.end()), long_p(p.start(), p.end());
        EXPECT_LE(found.error, kResolution);
        EXPECT_LE(double(deepestSample(*surface, truth, long_f, long_p, random)),
                  found.point.depth + found.error + 1e-12);
        if (found.point.depth == 0.0) continue;
        ++deep;
        EXPECT_NEAR(double(truth.depth(found.point.p_G.cast<Real>())), found.point.depth, 1e-12);
        // It is a point of the surface at that time.
        const Vector3r p_P =
            inFrame(long_p.pose(found.point.s), long_f.pose(found.point.s) * found.point.p_G.cast<Real>());
        Real off = 1e300L;
        for (const RoundedTriangle& t : test::roundedTriangles(*surface))
          off = std::min(off, test::triangleDistance(test::exact(t.corners), {p_P, p_P, p_P}));
        EXPECT_LT(double(off), 1e-12);
        // Its normal points out of the solid.
        const Vector3d outside = found.point.p_G + (found.point.depth + 1e-7) * found.point.out_G;
        EXPECT_LT(double(truth.depth(outside.cast<Real>())), 0.0);
      }
    }
  }
  EXPECT_GT(deep, test::rounds(75));
}

/// What a search keeps from one motion to the next bounds depths in all later ones: it slides, turns, jumps, leaves and
/// comes back.
TEST(DepthSearch, WhatIsKeptHoldsInLaterMotions) {
  constexpr double kResolution = 5e-5;
  Random random(11);
  const TriangleMesh box = test::boxMesh({0.05, 0.04, 0.03}), ball = test::icosphere(0.05, 1),
                     torus = test::torusMesh(0.05, 0.02, 12, 8);
  const TriangleMesh hollow = merged(test::boxMesh({0.05, 0.05, 0.05}), test::flipped(test::icosphere(0.045, 1)));
  int deep = 0;
  for (const TriangleMesh& inside : {box, ball, torus, hollow}) {
    const DepthSolid solid = solidOf(inside);
    const MeshTruth truth(inside);
    for (const TriangleMesh& surface : {box, torus}) {
      const BoxTree tree = treeOf(surface);
      DepthSearch search(tree, solid, kResolution);
      Isometry3d X_FP = test::pose(random, 3.0, 0.05);
      std::optional<Isometry3d> last;
      Vector3d known = Vector3d::Zero();
      for (int i = 0; i < test::rounds(25); ++i) {
        const double scale = std::pow(10.0, test::uniform(random, -3.5, -0.5));
        if (i % 13 == 12) X_FP = X_FP * test::pose(random, scale, 0.1 * scale);
        if (i % 29 == 28) X_FP = test::pose(random, 3.0, 0.05);
        const ScrewMotion f(Isometry3d::Identity(), Isometry3d::Identity());
        const ScrewMotion p(X_FP, X_FP * test::pose(random, scale, 0.1 * scale));
        const RelativeMotionBounds bounds =
            relativeMotionBounds(worldTwist(f, {Vector3d::Zero(), 1.0}), worldTwist(p, tree.ball()));
        const TwoBodyMotion motion{0.0, 1.0, f, p, bounds.acceleration};
        search.begin(last ? maxDisplacement(*last, X_FP, tree.ball()) : kInfinity);
        DeepestPoint best;
        for (const double s : {0.0, 1.0})
          if (const DeepestPoint point = search.pointAt(known, motion, s); point.depth > best.depth) best = point;
        int pieces = 20000;
        search.run(motion, bounds.travel, best, pieces);
        EXPECT_LE(search.highest(), best.depth + kResolution);
        EXPECT_LE(double(deepestSample(surface, truth, LongScrew(f.start(), f.end()), LongScrew(p.start(), p.end()),
                                       random)),
                  std::max(best.depth, search.highest()) + 1e-12)
            << i;
        X_FP = p.end();
        last = X_FP;
        if (best.depth == 0.0) continue;
        ++deep;
        known = best.p_P;
        EXPECT_NEAR(double(truth.depth(best.p_G.cast<Real>())), best.depth, 1e-12);
      }
    }
  }
  EXPECT_GT(deep, test::rounds(40));
}

/// The planes that bound depths, also beside edges, in recesses and around cavities.
TEST(DepthSolid, NoPointIsDeeperThanBehindAPlane) {
  Random random(5);
  const TriangleMesh box = test::boxMesh({0.05, 0.04, 0.03}), torus = test::torusMesh(0.05, 0.02, 12, 8);
  const TriangleMesh hollow = merged(test::boxMesh({0.05, 0.05, 0.05}), test::flipped(test::icosphere(0.04, 1)));
  int held = 0;
  for (const TriangleMesh& mesh :
       {box, torus, hollow, merged(box, test::translated(torus, {0.03, 0.01, 0})), test::icosphere(0.05, 1)}) {
    const auto made = std::make_shared<Solid>(mesh);
    const DepthSolid solid(made, Isometry3d::Identity());
    const MeshTruth truth(made->boundary());
    for (int i = 0; i < test::rounds(400); ++i) {
      const double size = std::pow(10.0, test::uniform(random, -4.0, -1.5));
      const Vector3d center = test::uniform(random, 0.0, 0.06) * test::direction(random);
      const PointDepth depth = solid.at(center);
      const bool of_triangle = i % 2 == 0;
      const Vector3d normal = of_triangle ? solid.normalOf(depth.triangle) : depth.out;
      const DepthPlane plane = solid.planeAlong(normal, of_triangle ? depth.triangle : -1, center, size, depth);
      for (int k = 0; k < 5; ++k) {
        const Vector3d p = center + test::uniform(random, 0.0, 2.0) * size * test::direction(random);
        if (!plane.holdsAt(p)) continue;
        const double at = double(truth.depth(p.cast<Real>()));
        if (at <= 0.0) continue;
        ++held;
        ASSERT_LE(at, plane.depthBehind(p) + 1e-10) << i;
      }
    }
  }
  EXPECT_GT(held, test::rounds(1000));
}

TEST(DepthSearch, OfABallIsWhereItFacesIn) {
  // A ball moves 2 mm into the face at z = 0.03 of a box.
  const TriangleMesh box = test::boxMesh({0.05, 0.04, 0.03});
  const DepthSolid solid = solidOf(box);
  const BoxTree ball({RoundedTriangle{{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}, 0.02}});
  const ScrewMotion rest(Isometry3d::Identity(), Isometry3d::Identity());
  const Isometry3d high(Eigen::Translation3d(0.01, 0.005, 0.06)), low(Eigen::Translation3d(0.01, 0.005, 0.048));
  const Found found = search(ball, solid, rest, ScrewMotion(high, low), 1e-5);
  EXPECT_NEAR(found.point.depth, 0.002, 1e-5);
  EXPECT_LE(0.002, found.point.depth + found.error + 1e-12);
  EXPECT_LE(found.error, 2e-5);
  EXPECT_NEAR((found.point.p_G - Vector3d(0.01, 0.005, 0.028)).norm(), 0.0, 1e-4);
}

/// A ball flies along a floor, 3 mm above it, into a wall that rises from it: nothing is near the middle of its path
/// but the floor.
TEST(DepthSearch, OfABallThatFliesAlongAFloorIntoAWall) {
  constexpr double kRadius = 0.022, kHeight = 0.0252, kWay = 0.02, kDepth = 0.006;
  const TriangleMesh corner = test::meshOf({test::boxAt({0.0, 0.0, -0.05}, {0.2, 0.2, 0.05}),
                                            test::boxAt({0.1, 0.0, 0.05}, {0.1, 0.2, 0.05})});
  const DepthSolid solid(std::make_shared<Solid>(corner), Isometry3d::Identity());
  const BoxTree ball({RoundedTriangle{{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}, kRadius}});
  const ScrewMotion rest(Isometry3d::Identity(), Isometry3d::Identity());
  const auto at = [&](double x) { return Isometry3d(Eigen::Translation3d(x, 0.013, kHeight)); };
  const double end = kDepth - kRadius;
  const ScrewMotion flight(at(end - kWay), at(end));
  const RelativeMotionBounds bounds =
      relativeMotionBounds(worldTwist(rest, {Vector3d::Zero(), 1.0}), worldTwist(flight, ball.ball()));
  DepthSearch search(ball, solid, 5e-5);
  search.begin(0.0);
  DeepestPoint best;
  int pieces = 20000;
  search.run({0.0, 1.0, rest, flight, bounds.acceleration}, bounds.travel, best, pieces);
  EXPECT_GE(std::max(best.depth, search.highest()), kDepth - 1e-9);
  EXPECT_NEAR(best.depth, kDepth, 1e-4);
}

TEST(DepthSearch, OfPrimitivesIsExact) {
  const DepthSolid solid = solidOf(tessellate(Box::fromSize({0.1, 0.08, 0.06}), 1.0));
  const TriangleMesh ball = test::icosphere(0.02, 3);
  const BoxTree tree = treeOf(ball);
  const ScrewMotion rest(Isometry3d::Identity(), Isometry3d::Identity());
  const Isometry3d at(Eigen::Translation3d(0.0, 0.0, 0.045));
  const Found found = search(tree, solid, rest, ScrewMotion(at, at), 1e-6);
  double lowest = 1.0;
  for (const Vector3d& v : ball.vertices) lowest = std::min(lowest, v.z() + 0.045);
  EXPECT_NEAR(found.point.depth, 0.03 - lowest, 1e-12);
  EXPECT_LE(found.error, 1e-6);
}

TEST(DepthSearch, WhatIsLeftWithoutTimeIsInTheError) {
  Random random(3);
  const TriangleMesh torus = test::torusMesh(0.05, 0.02, 12, 8);
  const DepthSolid solid = solidOf(torus);
  const MeshTruth truth(torus);
  const BoxTree tree = treeOf(torus);
  const Isometry3d X(Eigen::Translation3d(0.06, 0.01, 0.0));
  const ScrewMotion f(Isometry3d::Identity(), Isometry3d::Identity()), p(X, X * test::pose(random, 1.0, 0.03));
  double last = 1.0;
  for (const int pieces : {0, 1, 10, 100, 20000}) {
    const Found found = search(tree, solid, f, p, 1e-6, pieces);
    EXPECT_LE(double(deepestSample(torus, truth, LongScrew(f.start(), f.end()), LongScrew(p.start(), p.end()), random)),
              found.point.depth + found.error + 1e-12)
        << pieces;
    EXPECT_LE(found.error, last + 1e-6);
    last = found.error;
  }
  EXPECT_LE(last, 1e-5);
}

}  // namespace sdf_ccd::depth_search_test
