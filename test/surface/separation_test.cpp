#include "surface/separation.h"

#include <gtest/gtest.h>

#include "sdf_ccd/primitive.h"
#include "surface/separation_case.h"

namespace sdf_ccd::separation_test {

using test::Random;
using test::treeOf;
using Case = test::SeparationCase;

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
  const TriangleMesh disc = tessellate(Cylinder::fromRadiusAndLength(radius, 2.0 * 0.2 * radius), 1e-4 * radius),
                     thin =
                         tessellate(Cylinder::fromRadiusAndLength(radius, 2.0 * (0.2 * radius - gap)), 1e-4 * radius);
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
    const BoxTree disc = treeOf(tessellate(Cylinder::fromRadiusAndLength(radius, 0.1), 1e-4 * radius));
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
  const BoxTree disc = treeOf(tessellate(Cylinder::fromRadiusAndLength(0.1, 0.1), 1e-5));
  Isometry3d above = Isometry3d::Identity();
  above.translation().z() = 0.1 + 1e-6;
  const Isometry3d at_rest = Isometry3d::Identity();
  const Separation found = Case{&disc, &disc, at_rest, at_rest, above, above}.query();
  ASSERT_EQ(found.state, SeparationState::kApart);
  EXPECT_NEAR(found.distance, 1e-6, 1e-12);
  EXPECT_LT(found.tests, 2000);
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

}  // namespace sdf_ccd::separation_test
