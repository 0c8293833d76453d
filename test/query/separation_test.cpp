#include "query/separation.h"

#include <gtest/gtest.h>

#include "oracle/least_value.h"
#include "oracle/long_screw.h"
#include "oracle/random.h"
#include "oracle/rounded_triangles.h"
#include "oracle/shapes.h"
#include "sdf_ccd/geometry/primitive.h"

namespace sdf_ccd {
namespace {

using test::LongPose;
using test::LongScrew;
using test::Random;
using test::Real;
using test::treeOf;
using test::Triangle3r;
using test::Vector3r;

/// Two trees and their motions, with exact distances in long double.
struct Case {
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
        Triangle3r t = test::exact(tree.triangle(i).corners);
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
        least = std::min(least, test::triangleDistance(in_a[i], in_b[k]) - radii);
      }
    }
    return std::max<Real>(least, 0);
  }

  /// The smallest distance found at some times, and by a local search from the best of them: an upper bound.
  Real leastFound(int samples = 24) const {
    return test::leastFound([&](Real s, Real best) { return distanceAt(s, best); }, samples, 1e-5L);
  }
};

struct Shapes {
  std::vector<BoxTree> trees;

  Shapes() {
    trees.push_back(treeOf(test::boxMesh({0.1, 0.06, 0.02})));
    trees.push_back(treeOf(test::torusMesh(0.1, 0.03, 8, 5)));
    trees.push_back(treeOf(test::icosphere(0.08, 1)));
    trees.push_back(treeOf(test::translated(test::boxMesh({0.2, 0.001, 0.03}), {0.3, 0, 0})));
    TriangleMesh sheet;
    sheet.vertices = {{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0.02}, {-0.1, 0.1, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    trees.push_back(treeOf(sheet));
    trees.push_back(BoxTree({{{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}, 0.05}}));  // a ball
    trees.push_back(treeOf(test::boxMesh({0.05, 0.05, 0.05}), 0.01));
  }
};

/// A random case: both bodies move by at most `travel` and rotate by at most `turn`; halfway their distance is `apart`.
Case draw(const Shapes& shapes, Random& random, double travel, double turn, double apart) {
  Case c;
  c.a = &shapes.trees[random() % shapes.trees.size()];
  c.b = &shapes.trees[random() % shapes.trees.size()];
  const Isometry3d A = test::pose(random, 3.0, 1.0), B = test::pose(random, 3.0, 1.0);
  const auto around = [&](const Isometry3d& X, double part) {
    Isometry3d moved = X;
    const Vector3d axis = test::direction(random);
    moved.linear() = Eigen::AngleAxisd(part * test::uniform(random, -turn, turn), axis) * X.linear();
    moved.translation() += part * test::uniform(random, 0, travel) * test::direction(random);
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

/// For random motions, fast and slow, far and near: no lower bound exceeds the distance, and every crossing is real.
TEST(Separation, BoundsAndCrossingsAreTrue) {
  const Shapes shapes;
  Random random(1);
  SeparationMemory memory;
  long apart = 0, crossing = 0, open = 0;
  std::vector<double> ratios;  // of the bound to the distance found
  for (int trial = 0; trial < 250; ++trial) {
    const double travel = std::pow(10.0, test::uniform(random, -4, -0.3));
    const Case c = draw(shapes, random, travel, 3 * travel, std::pow(10.0, test::uniform(random, -4.5, -0.7)));
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
  EXPECT_GT(apart, 120);
  EXPECT_GT(crossing, 40);
  EXPECT_LT(open, 40);
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
    Case best = draw(shapes, random, travel, 5 * travel, travel * test::uniform(random, 0.01, 0.5));
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

/// A body passes through a thin plate in one step; at both ends they are apart.
TEST(Separation, NothingTunnels) {
  const BoxTree plate = treeOf(test::boxMesh({0.1, 0.1, 5e-4})), hand = treeOf(test::boxMesh({0.02, 0.02, 0.02}));
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    Case c{&plate,
           &hand,
           Isometry3d::Identity(),
           Isometry3d::Identity(),
           test::pose(random, 3, 0),
           test::pose(random, 3, 0)};
    c.A_start = c.A_end = test::pose(random, 3.0, 1.0);
    const Vector3d offset(test::uniform(random, -0.05, 0.05), test::uniform(random, -0.05, 0.05), 0);
    c.B_end.linear() = c.B_start.linear();
    c.B_start.translation() = offset + Vector3d(0, 0, test::uniform(random, 0.05, 0.5));
    c.B_end.translation() = offset - Vector3d(0, 0, test::uniform(random, 0.05, 0.5));
    c.B_start = c.A_start * c.B_start;
    c.B_end = c.A_end * c.B_end;
    EXPECT_EQ(c.query().state, SeparationState::kCrossing) << trial;
  }
}

/// In one long step, a gap to a plate of 0.1 or 0.01 mm is distinguished from a contact.
TEST(Separation, GrazingIsToldFromTouching) {
  const BoxTree plate = treeOf(test::boxMesh({0.5, 0.5, 0.01})), hand = treeOf(test::boxMesh({0.02, 0.03, 0.04}));
  for (const double gap : {1e-4, 1e-5, -1e-5, -1e-4}) {
    Case c{
        &plate, &hand, Isometry3d::Identity(), Isometry3d::Identity(), Isometry3d::Identity(), Isometry3d::Identity()};
    c.B_start.translation() = Vector3d(-0.4, 0.1, 0.05 + gap);
    c.B_end.translation() = Vector3d(0.4, -0.1, 0.05 + gap);
    EXPECT_EQ(c.query().state, gap > 0 ? SeparationState::kApart : SeparationState::kCrossing) << gap;
  }
}

/// Balls are exact.
TEST(Separation, BallsTouchWhereTheirRadiiSay) {
  const auto ball = [](double radius) {
    return BoxTree({{{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}, radius}});
  };
  const BoxTree a = ball(0.3), b = ball(0.2), wall = treeOf(test::boxMesh({1, 1, 0.1}));
  const auto at = [](double x) {
    Isometry3d X = Isometry3d::Identity();
    X.translation() = Vector3d(0, 0, x);
    return X;
  };
  const auto stateOf = [&](const BoxTree& first, const BoxTree& second, double x) {
    return Case{&first, &second, at(0), at(0), at(x), at(x)}.query().state;
  };
  EXPECT_EQ(stateOf(a, b, 0.5 + 1e-9), SeparationState::kApart);
  EXPECT_EQ(stateOf(a, b, 0.5 - 1e-9), SeparationState::kCrossing);
  EXPECT_EQ(stateOf(wall, b, 0.3 + 1e-9), SeparationState::kApart);
  EXPECT_EQ(stateOf(wall, b, 0.3 - 1e-9), SeparationState::kCrossing);
}

/// The reported point of rounded triangles that cross is on the surface of one and in the other, not a ball's centre.
TEST(Separation, ACrossingIsOnASurface) {
  const BoxTree large({{{Vector3d(0, 0, 0), Vector3d(0, 0, 0), Vector3d(0, 0, 0)}, 0.5}}),
      small({{{Vector3d(0, 0, 0), Vector3d(0, 0, 0), Vector3d(0, 0, 0)}, 0.02}}),
      wall = treeOf(test::boxMesh({0.2, 0.2, 0.2}));
  const auto crossing = [&](const BoxTree& a, const BoxTree& b, const Vector3d& p) {
    Isometry3d X = Isometry3d::Identity();
    X.translation() = p;
    const Separation found = Case{&a, &b, Isometry3d::Identity(), Isometry3d::Identity(), X, X}.query();
    EXPECT_EQ(found.state, SeparationState::kCrossing);
    return found.p_A;
  };
  const Vector3d u = Vector3d(1, 2, -2).normalized();
  for (const double depth : {1e-6, 1e-3, 0.03}) {
    const Vector3d apart = (0.52 - depth) * u;
    for (const auto& [p, q] : {std::pair(crossing(large, small, apart), apart),
                               std::pair(Vector3d(crossing(small, large, -apart) + apart), apart)}) {
      EXPECT_LE(p.norm(), 0.5 + 1e-9) << depth;
      EXPECT_LE((p - q).norm(), 0.02 + 1e-9) << depth;
      EXPECT_LT(std::min(std::abs(p.norm() - 0.5), std::abs((p - q).norm() - 0.02)), 1e-9) << depth;
    }
    const Vector3d on_face = crossing(large, wall, {0.7 - depth, 0.01, 0.02});
    EXPECT_LE(on_face.norm(), 0.5 + 1e-9) << depth;
    EXPECT_NEAR(on_face.x(), 0.5 - depth, 1e-9);
  }
  EXPECT_NEAR(crossing(large, small, Vector3d::Zero()).norm(), 0.02, 1e-9);
}

/// Bodies that rotate together about the world's origin: only the relative motion counts.
TEST(Separation, BodiesThatMoveAsOneKeepTheirDistance) {
  const BoxTree a = treeOf(test::torusMesh(0.1, 0.03, 16, 8)), b = treeOf(test::boxMesh({0.05, 0.05, 0.05}));
  Isometry3d X_AB = Isometry3d::Identity();
  X_AB.translation() = Vector3d(0.19, 0.02, 0.01);
  const Isometry3d turn(Eigen::AngleAxisd(1.5, Vector3d(1, 2, 3).normalized()));
  const Isometry3d X_WA(Eigen::Translation3d(0.5, 1.0, -0.3));
  Case c{&a, &b, X_WA, turn * X_WA, X_WA * X_AB, turn * X_WA * X_AB};
  const Separation found = c.query();
  ASSERT_EQ(found.state, SeparationState::kApart);
  const double truth = double(c.distanceAt(0.3L));
  EXPECT_LE(found.distance, truth + 1e-13);
  EXPECT_GT(found.distance, 0.5 * truth);
}

/// Triangles that lie on each other everywhere: the query ends with nothing proved.
TEST(Separation, SurfacesThatLieOnEachOtherStayOpen) {
  TriangleMesh sheet;
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i)
    for (int k = 0; k <= kSteps; ++k) sheet.vertices.push_back({0.01 * i, 0.01 * k, 0});
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k) {
      const int at = i * (kSteps + 1) + k;
      sheet.triangles.push_back({at, at + 1, at + kSteps + 1});
      sheet.triangles.push_back({at + 1, at + kSteps + 2, at + kSteps + 1});
    }
  const BoxTree tree = treeOf(sheet);
  Isometry3d slid = Isometry3d::Identity();
  slid.translation().x() = 0.003;
  Case c{&tree, &tree, Isometry3d::Identity(), Isometry3d::Identity(), Isometry3d::Identity(), slid};
  EXPECT_EQ(c.query().state, SeparationState::kOpen);
}

/// Parts of joints that turn on each other about z, a gap apart: `outer` rests, `inner` turns.
struct JointParts {
  const char* name;
  TriangleMesh outer, inner;
};

std::vector<JointParts> jointParts(double radius, double gap) {
  const TriangleMesh disc = tessellate(Cylinder{radius, 0.2 * radius}, 1e-4 * radius),
                     thin = tessellate(Cylinder{radius, 0.2 * radius - gap}, 1e-4 * radius);
  const TriangleMesh bracket =
      test::translated(test::boxMesh({0.2 * radius, 0.4 * radius, radius}), {1.3 * radius, 0, 0.5 * radius});
  const auto above = [&](double z) { return test::translated(disc, {0, 0, z}); };
  return {{"faces", disc, above(0.4 * radius + gap)},
          {"faces with a bracket beside", merged(disc, bracket), above(0.4 * radius + gap)},
          {"fork", merged(above(0.4 * radius), above(-0.4 * radius)), thin}};
}

/// Faces of many triangles that turn on each other, as those of links on a joint. Bounds that were the same in all
/// directions needed a test for each pair of triangles.
TEST(Separation, PartsOfJointsThatTurnOnEachOtherAreApart) {
  for (const double radius : {0.02, 0.1})
    for (const double gap : {5e-4, 2e-3})
      for (const JointParts& parts : jointParts(radius, gap))
        for (const double turn : {0.003, 0.03, 0.1, 0.3}) {
          const BoxTree a = treeOf(parts.outer), b = treeOf(parts.inner);
          const Isometry3d tilted(Eigen::AngleAxisd(0.7, Vector3d(3, -1, 2).normalized())),
              turned(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
          for (const bool is_exchanged : {false, true}) {
            const Case c = is_exchanged ? Case{&b, &a, tilted, tilted * turned, tilted, tilted}
                                        : Case{&a, &b, tilted, tilted, tilted, tilted * turned};
            const Separation found = c.query();
            ASSERT_EQ(found.state, SeparationState::kApart) << parts.name << " " << radius << " " << gap << " " << turn;
            EXPECT_LE(found.distance, gap * (1.0 + 1e-9));
            EXPECT_LT(found.tests, 12000) << parts.name << " " << radius << " " << gap << " " << turn;
          }
        }
}

/// The same of faces alone, closer and up to nearly half a revolution.
TEST(Separation, FacesMayTurnByMuch) {
  for (const double radius : {0.02, 0.1, 0.5}) {
    const BoxTree disc = treeOf(tessellate(Cylinder{radius, 0.05}, 1e-4 * radius));
    for (const double gap : {1e-4, 5e-4})
      for (const double turn : {0.1, 1.0, 3.0})
        for (const double aside : {0.0, 0.3}) {  // of the radius
          Isometry3d start = Isometry3d::Identity(), end = start;
          start.translation() = end.translation() = Vector3d(aside * radius, 0.0, 0.1 + gap);
          end.linear() = Eigen::AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix();
          const Case c{&disc, &disc, Isometry3d::Identity(), Isometry3d::Identity(), start, end};
          const Separation found = c.query();
          ASSERT_EQ(found.state, SeparationState::kApart) << radius << " " << gap << " " << turn << " " << aside;
          EXPECT_LE(found.distance, gap * (1.0 + 1e-9));
        }
  }
}

/// Faces at rest that are closer than single precision tells.
TEST(Separation, FacesAMicrometreApartTakeFewTests) {
  const BoxTree disc = treeOf(tessellate(Cylinder{0.1, 0.05}, 1e-5));
  Isometry3d above = Isometry3d::Identity();
  above.translation().z() = 0.1 + 1e-6;
  const Isometry3d at_rest = Isometry3d::Identity();
  const Separation found = Case{&disc, &disc, at_rest, at_rest, above, above}.query();
  ASSERT_EQ(found.state, SeparationState::kApart);
  EXPECT_NEAR(found.distance, 1e-6, 1e-12);
  EXPECT_LT(found.tests, 2000);
}

/// Bounds of surfaces of many triangles, which long searches and planes between hulls prove.
TEST(Separation, BoundsOfDenseSurfacesAreTrue) {
  Shapes shapes;
  shapes.trees.clear();
  shapes.trees.push_back(treeOf(test::torusMesh(0.1, 0.03, 20, 10)));
  shapes.trees.push_back(treeOf(test::icosphere(0.08, 2)));
  shapes.trees.push_back(treeOf(tessellate(Cylinder{0.05, 0.01}, 1e-4)));
  shapes.trees.push_back(treeOf(merged(tessellate(Cylinder{0.05, 0.01}, 1e-3),
                                       test::translated(test::boxMesh({0.01, 0.02, 0.06}), {0.07, 0, 0.03})),
                                2e-3));
  Random random(11);
  SeparationMemory memory;
  long apart = 0, long_searches = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const double turn = std::pow(10.0, test::uniform(random, -2.5, 0.2));
    const Case c = draw(shapes, random, 0.03 * turn, turn, std::pow(10.0, test::uniform(random, -4, -2)));
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
  EXPECT_GT(apart, 20);
  EXPECT_GT(long_searches, 30);
}

/// A dense shell around a box's corner is far from the box, but not along any axis of the box; and no plane separates
/// the two. Bounds along single axes needed a test for each of its triangles, and ran out of tests.
TEST(Separation, ADenseShellAroundACornerTakesFewTests) {
  constexpr double kRadius = 0.15;
  TriangleMesh shell = test::icosphere(kRadius, 6);
  const auto reaches = [&](const Vector3i& t) {
    return (shell.vertices[t[0]].array() <= -0.02).any() || (shell.vertices[t[1]].array() <= -0.02).any() ||
           (shell.vertices[t[2]].array() <= -0.02).any();
  };
  shell.triangles.erase(std::remove_if(shell.triangles.begin(), shell.triangles.end(), reaches), shell.triangles.end());
  const BoxTree dense = treeOf(shell);
  ASSERT_GT(dense.size(), 10000U);
  const Isometry3d at_rest = Isometry3d::Identity();
  for (const double half : {0.1, 0.4}) {  // a box whose corner is the shell's centre
    const BoxTree box = treeOf(test::translated(test::boxMesh({half, half, half}), Vector3d::Constant(-half)));
    for (const auto& [a, b] : {std::pair{&box, &dense}, {&dense, &box}}) {
      const Separation found = Case{a, b, at_rest, at_rest, at_rest, at_rest}.query();
      ASSERT_EQ(found.state, SeparationState::kApart) << half;
      EXPECT_LE(found.distance, kRadius);
      EXPECT_GT(found.distance, 0.4 * kRadius);
      EXPECT_LT(found.tests, 1000);
    }
  }
}

TEST(Separation, NoMoreTestsThanAreAllowed) {
  // Two balls of many triangles, one in the other, closer than the resolution: many pairs of triangles stay open.
  const BoxTree inner = treeOf(test::icosphere(0.09999, 4)), outer = treeOf(test::icosphere(0.1, 4));
  const Isometry3d at_rest = Isometry3d::Identity();
  const Case nested{&outer,  &inner,  at_rest,
                    at_rest, at_rest, Isometry3d(Eigen::AngleAxisd(0.2, Vector3d(1, 2, 3).normalized()))};
  for (const int allowed : {100, 1000, 20000}) {
    SeparationOptions options;
    options.max_tests = allowed;
    const Separation found = nested.query(options);
    EXPECT_NE(found.state, SeparationState::kApart);
    EXPECT_GT(found.tests, 0);
    EXPECT_LE(found.tests, allowed + 600) << "but for those that are begun together";
  }
}

}  // namespace
}  // namespace sdf_ccd
