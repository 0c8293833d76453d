#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "oracle/least_value.h"
#include "oracle/long_screw.h"
#include "oracle/random.h"
#include "oracle/rounded_triangles.h"
#include "oracle/shapes.h"
#include "surface/separation.h"

namespace sdf_ccd::test {

/// Two trees and their motions, with exact distances in long double.
struct SeparationCase {
  const BoxTree *a, *b;
  Isometry3d A_start, A_end, B_start, B_end;

  TwoBodyMotion motion(const ScrewMotion& X_WA, const ScrewMotion& X_WB) const {
    const WorldTwist twist_a = worldTwist(X_WA, a->ball()), twist_b = worldTwist(X_WB, b->ball());
    return {0.0, 1.0, X_WA, X_WB, relativeMotionBounds(twist_a, twist_b).acceleration};
  }

  Separation query(const SeparationOptions& options, SeparationWitness& witness, SeparationMemory& memory) const {
    const ScrewMotion X_WA(A_start, A_end), X_WB(B_start, B_end);
    return separation(*a, *b, motion(X_WA, X_WB), options, witness, memory);
  }
  Separation query(const SeparationOptions& options = {}) const {
    SeparationWitness witness;
    SeparationMemory memory;
    return query(options, witness, memory);
  }

  /// Distance of the surfaces at a time; 0 if they cross. If it exceeds `least`, any value of at least `least`.
  Real distanceAt(Real s, Real least = 1e300L) const {
    const LongPose X_WA = LongScrew(A_start, A_end).pose(s), X_WB = LongScrew(B_start, B_end).pose(s);
    const auto placed = [](const BoxTree& tree, const LongPose& X) {
      std::vector<Triangle3r> all;
      for (int i = 0; i < int(tree.size()); ++i) {
        Triangle3r t = exact(tree.triangle(i).corners);
        for (Vector3r& p : t) p = X * p;
        all.push_back(t);
      }
      return all;
    };
    const std::vector<Triangle3r> in_a = placed(*a, X_WA), in_b = placed(*b, X_WB);
    const auto ball = [](const Triangle3r& t) {
      const Vector3r center = (t[0] + t[1] + t[2]) / 3;
      return std::pair(center, std::max({(t[0] - center).norm(), (t[1] - center).norm(), (t[2] - center).norm()}));
    };
    std::vector<std::pair<Vector3r, Real>> balls_b;
    for (const Triangle3r& t : in_b) balls_b.push_back(ball(t));
    // First an upper bound from two corners that are near each other.
    std::size_t first = 0;
    for (std::size_t i = 1; i < in_a.size(); ++i)
      if ((in_a[i][0] - balls_b[0].first).norm() < (in_a[first][0] - balls_b[0].first).norm()) first = i;
    for (std::size_t k = 0; k < in_b.size(); ++k)
      if ((in_b[k][0] - in_a[first][0]).norm() - a->triangle(first).radius - b->triangle(k).radius < least)
        least =
            std::max<Real>((in_b[k][0] - in_a[first][0]).norm() - a->triangle(first).radius - b->triangle(k).radius, 0);
    for (std::size_t i = 0; i < in_a.size() && least > 0; ++i) {
      const auto [center, reach] = ball(in_a[i]);
      for (std::size_t k = 0; k < in_b.size(); ++k) {
        const Real radii = a->triangle(i).radius + b->triangle(k).radius;
        if ((center - balls_b[k].first).norm() - reach - balls_b[k].second - radii >= least) continue;
        least = std::min(least, triangleDistance(in_a[i], in_b[k]) - radii);
      }
    }
    return std::max<Real>(least, 0);
  }

  /// The smallest distance found at some times, and by a local search from the best of them: an upper bound.
  Real leastFound(int samples = 24) const {
    return test::leastFound([&](Real s, Real best) { return distanceAt(s, best); }, samples, 1e-5L);
  }
};

struct SeparationShapes {
  std::vector<BoxTree> trees;

  SeparationShapes() {
    trees.push_back(treeOf(boxMesh({0.1, 0.06, 0.02})));
    trees.push_back(treeOf(torusMesh(0.1, 0.03, 8, 5)));
    trees.push_back(treeOf(icosphere(0.08, 1)));
    trees.push_back(treeOf(translated(boxMesh({0.2, 0.001, 0.03}), {0.3, 0, 0})));
    TriangleMesh sheet;
    sheet.vertices = {{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0.02}, {-0.1, 0.1, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    trees.push_back(treeOf(sheet));
    trees.push_back(BoxTree({{{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}, 0.05}}));  // a ball
    trees.push_back(treeOf(boxMesh({0.05, 0.05, 0.05}), 0.01));
  }
};

/// A random case: both bodies move by at most `travel` and rotate by at most `turn`; halfway their distance is `apart`.
inline SeparationCase drawSeparation(const SeparationShapes& shapes, Random& random, double travel, double turn,
                                     double apart) {
  SeparationCase c;
  c.a = &shapes.trees[random() % shapes.trees.size()];
  c.b = &shapes.trees[random() % shapes.trees.size()];
  const Isometry3d A = pose(random, 3.0, 1.0), B = pose(random, 3.0, 1.0);
  const auto around = [&](const Isometry3d& X, double part) {
    Isometry3d moved = X;
    const Vector3d axis = direction(random);
    moved.linear() = Eigen::AngleAxisd(part * uniform(random, -turn, turn), axis) * X.linear();
    moved.translation() += part * uniform(random, 0, travel) * direction(random);
    return moved;
  };
  c.A_start = around(A, 1), c.A_end = around(A, 1), c.B_start = around(B, 1), c.B_end = around(B, 1);
  // B is moved along the segment between the nearest corners halfway.
  for (int step = 0; step < 3; ++step) {
    const Isometry3d X_WA = ScrewMotion(c.A_start, c.A_end).pose(0.5), X_WB = ScrewMotion(c.B_start, c.B_end).pose(0.5);
    double best = 1e300;
    Vector3d way = Vector3d::UnitX();
    for (std::size_t i = 0; i < c.a->size(); ++i)
      for (std::size_t k = 0; k < c.b->size(); ++k) {
        const Vector3d p = X_WA * c.a->triangle(i).corners[0], q = X_WB * c.b->triangle(k).corners[0];
        if ((q - p).norm() < best) best = (q - p).norm(), way = q - p;
      }
    const double distance = double(c.distanceAt(0.5L));
    const Vector3d shift = (apart - (distance > 0 ? distance : -0.02)) * way.normalized();
    c.B_start.translation() += shift;
    c.B_end.translation() += shift;
  }
  return c;
}

}  // namespace sdf_ccd::test
