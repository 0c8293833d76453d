#include "dynamics/integrator.h"

#include <gtest/gtest.h>

#include "dynamics/collision_shape.h"
#include "oracle/bodies.h"
#include "oracle/persistent_contact.h"
#include "oracle/random.h"
#include "shell/point_shell.h"

namespace sdf_ccd::integrator_test {

using namespace test;

constexpr Scheme kSchemes[] = {Scheme::kContinuous, Scheme::kDiscrete, Scheme::kImplicit};

// 20 damping ratios, as in the chart of design §3.10.
TEST(Integrator, ContinuousIsStableUpToItsClosedForm) {
  for (int i = 1; i <= 20; ++i) {
    const double zeta = 0.05 * i;
    EXPECT_NEAR(largestStable(Scheme::kContinuous, zeta, 8.0, 4000), continuousLimit(zeta),
                0.02 * continuousLimit(zeta))
        << zeta;
  }
}

TEST(Integrator, DiscreteIsStableUpToItsClosedForm) {
  for (int i = 1; i <= 20; ++i) {
    const double zeta = 0.05 * i;
    EXPECT_NEAR(largestStable(Scheme::kDiscrete, zeta, 8.0, 4000), discreteLimit(zeta), 0.02 * discreteLimit(zeta))
        << zeta;
  }
}

TEST(Integrator, ImplicitIsStableAtAnyStep) {
  for (const double zeta : {0.0, 0.05, 0.5, 1.0, 10.0}) {
    for (const double s : {1e-2, 1.0, 2.0, 10.0, 1e3, 1e6}) {
      EXPECT_TRUE(staysStable(Scheme::kImplicit, zeta, s, 1000)) << zeta << " " << s;
    }
  }
}

TEST(Integrator, ImplicitDampsAsItsDocumentationSays) {
  // ζ = 0: each step reduces the amplitude by √(1 + s²), like a damping ratio of s/2 if s is small.
  const double s = 0.1;
  RigidWorld world;
  world.bodies = {groundBody(), pointBody("point", 1.0)};
  world.contact.stiffness_per = StiffnessPer::kPoint;
  world.contact.stiffness = 1.0;
  Simulation simulation(world, {at(Vector3d::Zero()), at({0, 0, world.gravity.z() + 0.1})}, Scheme::kImplicit, s);
  const auto amplitude = [&] {
    return std::hypot(simulation.states()[1].X_OB.translation().z() - world.gravity.z(),
                      simulation.states()[1].velocity.z());
  };
  const double before = amplitude();
  for (int i = 0; i < 50; ++i) simulation.advance();
  EXPECT_NEAR(std::log(amplitude() / before), -25.0 * std::log1p(s * s), 0.02);
}

TEST(Integrator, SphereRestsAtItsAnalyticDepth) {
  // m g = π k R δ² (design §3.8).
  const double R = 0.1, k = 1e8;
  const RigidBody ball = primitiveBody("ball", Sphere{R}, 1000.0, 0.002);
  RigidWorld world;
  world.bodies = {groundBody(), ball};
  world.contact.stiffness = k;
  const double depth = std::sqrt(ball.mass * 9.81 / (kPi * k * R));
  world.contact.damping = 2e5;
  for (const Scheme scheme : kSchemes) {
    Simulation simulation(world, {at(Vector3d::Zero()), at({0, 0, R})}, scheme, 2e-4);
    for (int i = 0; i < 5000; ++i) simulation.advance();
    EXPECT_NEAR(simulation.states()[1].X_OB.translation().z(), R - depth, 0.02 * depth) << toString(scheme);
    EXPECT_LT(std::abs(simulation.states()[1].velocity.z()), 1e-5) << toString(scheme);
  }
}

TEST(Integrator, SphereOnABoxOfFewPointsRestsAtItsAnalyticDepth) {
  // No point of the box is near the contact: with equal weights it would be half as stiff.
  const double R = 0.1, k = 1e8;
  const RigidBody ball = primitiveBody("ball", Sphere{R}, 1000.0, 0.002);
  RigidBody table = primitiveBody("table", Box::fromSize({1.0, 1.0, 0.2}), 1000.0, 0.08);
  table.fixed = true;
  RigidWorld world;
  world.bodies = {table, ball};
  world.contact.stiffness = k;
  world.contact.damping = 2e5;
  const double depth = std::sqrt(ball.mass * 9.81 / (kPi * k * R));
  for (const Scheme scheme : kSchemes) {
    Simulation simulation(world, {at(Vector3d::Zero()), at({0.02, 0.01, 0.1 + R - depth})}, scheme, 2e-4);
    for (int i = 0; i < 2000; ++i) simulation.advance();
    EXPECT_NEAR(simulation.states()[1].X_OB.translation().z(), 0.1 + R - depth, 0.02 * depth) << toString(scheme);
  }
}

TEST(Integrator, FreeFallIsExactForOursAndFirstOrderForTheOthers) {
  RigidWorld world;
  world.bodies = {pointBody("point", 2.0)};
  const double T = 1.0, dt = 0.01;
  for (const Scheme scheme : kSchemes) {
    Simulation simulation(world, {at({0, 0, 100.0}, {1.0, 0, 3.0})}, scheme, dt);
    for (int i = 0; i < 100; ++i) simulation.advance();
    const double z = 100.0 + 3.0 * T - 0.5 * 9.81 * T * T;
    const double lag = scheme == Scheme::kImplicit ? 0.0 : 0.5 * 9.81 * T * dt;
    EXPECT_NEAR(simulation.states()[0].X_OB.translation().z(), z - lag, 1e-10) << toString(scheme);
  }
}

/// Two irregular bodies that collide off centre in free space.
Simulation collision(Scheme scheme, double step) {
  RigidWorld world;
  world.gravity.setZero();
  world.contact.stiffness = 1e8;
  world.contact.damping = 1e4;
  world.bodies = {meshBody("torus", torusMesh(0.1, 0.04, 48, 24), 1000.0, 32, 0.01),
                  primitiveBody("box", Box::fromSize({0.1, 0.16, 0.06}), 500.0, 0.01)};
  return Simulation(world, {at({0, 0, 0}, {0.5, 0, 0}, {1, 2, 3}), at({0.23, 0.05, 0.02}, {-1, 0, 0}, {0, 5, 1})},
                    scheme, step);
}

TEST(Integrator, ActionEqualsReactionAndMomentumStays) {
  for (const Scheme scheme : kSchemes) {
    Simulation simulation = collision(scheme, 1e-4);
    const Wrench before = simulation.last().momentum;
    double reaction = 0.0;
    int contacts = 0;
    for (int i = 0; i < 2000; ++i) {
      const StepRecord& record = simulation.advance();
      reaction = std::max(reaction, record.reaction_error);
      contacts += record.contacts > 0;
    }
    EXPECT_GT(contacts, 10) << toString(scheme);
    EXPECT_LT(reaction, 1e-12) << toString(scheme);
    const Wrench after = simulation.last().momentum;
    const double scale = before.force.norm();
    EXPECT_LT((after.force - before.force).norm(), 1e-10 * scale) << toString(scheme);
    // The implicit scheme applies a moment at the step's end, so it conserves angular momentum to first order in the
    // step.
    const double tolerance = scheme == Scheme::kImplicit ? 2e-3 : 1e-10;
    EXPECT_LT((after.torque - before.torque).norm(), tolerance * before.torque.norm()) << toString(scheme);
  }
}

/// Depth of a point in a cube about the origin [m]; negative outside.
double depthInCube(double half_size, const Vector3d& p) {
  return half_size - p.cwiseAbs().maxCoeff();
}

TEST(Integrator, ImplicitLetsNoBallThroughACubeWhereverItWouldLeave) {
  const double half_size = 0.05, step = 0.01;
  RigidBody cube = primitiveBody("cube", Box::fromSize(Vector3d::Constant(2.0 * half_size)), 1000.0, 0.02);
  cube.fixed = true;
  RigidWorld world;
  world.gravity.setZero();
  world.contact.stiffness = 1e9;
  world.bodies = {cube, primitiveBody("ball", Sphere{0.005}, 2000.0, 0.002)};
  Random random(7);
  for (const double travel : {0.02, 0.05, 0.1, 0.2}) {  // in a step
    for (int i = 0; i < 100; ++i) {
      const Vector3d towards = direction(random), through = 0.8 * half_size * direction(random);
      const Vector3d start = through - (0.3 + uniform(random, 0.0, travel)) * towards;
      Simulation simulation(world, {at(Vector3d::Zero()), at(start, travel / step * towards)}, Scheme::kImplicit, step);
      double deepest = -1.0;
      for (int k = 0; k < 0.8 / travel + 4; ++k) {
        const Vector3d before = simulation.states()[1].X_OB.translation();
        simulation.advance();
        const Vector3d moved = simulation.states()[1].X_OB.translation() - before;
        for (int j = 0; j <= 100; ++j) deepest = std::max(deepest, depthInCube(half_size, before + 0.01 * j * moved));
      }
      EXPECT_LT(deepest, 0.001) << travel << " " << i;
    }
  }
}

TEST(Integrator, ImplicitLetsPointsPassAnEdgeThatTheyGraze) {
  RigidBody cube = primitiveBody("cube", Box::fromSize(Vector3d::Constant(0.1)), 1000.0, 0.02),
            rod = pointBody("rod", 1.0);
  cube.fixed = true;
  PointShell ends;
  ends.add({0, 0, 0}, -Vector3d::UnitZ(), 1.0F);
  ends.add({0.2, 0, 0}, -Vector3d::UnitZ(), 1.0F);
  rod.shape = makeShape(ends);
  RigidWorld world;
  world.gravity.setZero();
  world.contact.stiffness = 1e9;
  world.bodies = {cube, rod};
  // One end gets 2e-5 m deep beside an edge. The paths' tolerance is 1e-4 m.
  const Vector3d velocity(10.0, 0.0, -10.0), grazed(0.05 - 2e-5, 0.0, 0.05 - 2e-5);
  Simulation simulation(world, {at(Vector3d::Zero()), at(grazed - 0.005 * velocity, velocity)}, Scheme::kImplicit,
                        0.01);
  simulation.advance();
  EXPECT_LT((simulation.states()[1].velocity - velocity).norm(), 1e-9);
}

/// A tilted box that falls on the ground; with `far_energy` [J] not 0 also a ball that flies elsewhere.
Simulation fallingBox(double far_energy) {
  RigidWorld world;
  world.contact.stiffness = 1e10;
  world.bodies = {groundBody(), primitiveBody("box", Box::fromSize({0.1, 0.08, 0.06}), 1000.0, 0.02)};
  std::vector<BodyState> states = {at(Vector3d::Zero()), at({0, 0, 0.1})};
  states[1].X_OB.linear() = Eigen::AngleAxisd(0.5, Vector3d(1, 2, 0.3).normalized()).toRotationMatrix();
  if (far_energy > 0.0) {
    const double speed = 1000.0, density = 2.0 * far_energy / (speed * speed) / (4.0 / 3.0 * kPi);
    world.bodies.push_back(primitiveBody("far", Sphere{1.0}, density, 0.5));
    states.push_back(at({0, 1e5, 1e5}, {speed, 0, 0}));
  }
  return Simulation(world, states, Scheme::kImplicit, 1e-3);
}

TEST(Integrator, ImplicitSolvesEveryBodyAsIfItWereAlone) {
  for (const double energy : {1e6, 1e12, 1e15}) {
    Simulation alone = fallingBox(0.0), together = fallingBox(energy);
    int contacts = 0;
    for (int i = 0; i < 200; ++i) {
      contacts += alone.advance().contacts > 0;
      together.advance();
      const BodyState &expected = alone.states()[1], &state = together.states()[1];
      ASSERT_LT((state.X_OB.matrix() - expected.X_OB.matrix()).norm(), 1e-7) << energy << " " << i;
      ASSERT_LT((state.velocity - expected.velocity).norm(), 1e-4) << energy << " " << i;
    }
    EXPECT_GT(contacts, 2);
  }
}

TEST(Integrator, ImplicitRecordsTheContactsAtTheEndOfTheStep) {
  const RigidBody box = primitiveBody("box", Box::fromSize({0.1, 0.08, 0.06}), 1000.0, 0.02);
  Simulation simulation = fallingBox(1e12);
  int contacts = 0;
  for (int i = 0; i < 200; ++i) {
    const StepRecord& record = simulation.advance();
    double deepest = 0.0, elastic = 0.0;
    for (std::size_t k = 0; k < box.shape->shell.size(); ++k) {
      const double depth = -std::min((simulation.states()[1].X_OB * box.shape->shell.point(k)).z(), 0.0);
      deepest = std::max(deepest, depth);
      elastic += 0.5 * 1e10 * box.shape->shell.areas[k] * depth * depth;
    }
    EXPECT_NEAR(record.deepest, deepest, 1e-13 + 1e-8 * deepest) << i;
    EXPECT_NEAR(record.elastic, elastic, 1e-12 + 1e-9 * elastic) << i;
    contacts += deepest > 0.0;
  }
  EXPECT_GT(contacts, 2);
}

TEST(Integrator, ImplicitRestsInStiffContactWithoutHalvingSteps) {
  for (const double stiffness : {1e10, 1e12, 1e14}) {
    RigidWorld world;
    world.contact.stiffness = stiffness;
    world.bodies = {groundBody()};
    std::vector<BodyState> states = {at(Vector3d::Zero())};
    for (int i = 0; i < 3; ++i) {
      world.bodies.push_back(primitiveBody("box", Box::fromSize({0.1, 0.1, 0.1}), 1000.0, 0.02));
      states.push_back(at({0, 0, 0.05 + 0.1 * i}));
    }
    Simulation simulation(world, states, Scheme::kImplicit, 1e-3);
    int solves = 0;
    for (int i = 0; i < 100; ++i) {
      solves += simulation.advance().solves;
      EXPECT_EQ(simulation.last().energy_excess, 0.0) << stiffness << " " << i;
    }
    EXPECT_LT(solves, 1000) << stiffness;
  }
}

TEST(Integrator, ImplicitKeepsMomentumInStiffContactOfUnequalMasses) {
  for (const double ratio : {1.0, 1e-3, 1e-6}) {
    for (const double stiffness : {1e6, 1e9, 1e12}) {
      RigidBody box = primitiveBody("box", Box::fromSize({0.1, 0.1, 0.1}), 1000.0, 0.02),
                ball = primitiveBody("ball", Sphere{0.05}, 1000.0 * ratio, 0.02);
      RigidWorld world;
      world.gravity.setZero();
      world.contact.stiffness_per = StiffnessPer::kPoint;
      world.contact.stiffness = stiffness;
      world.bodies = {box, ball};
      Simulation simulation(world, {at(Vector3d::Zero()), at({0.013, 0.007, 0.6}, {0, 0, -1})}, Scheme::kImplicit, 1.0);
      const Vector3d before(0, 0, -ball.mass);
      for (int i = 0; i < 50; ++i) {
        const Vector3d after = simulation.advance().momentum.force;
        ASSERT_LT((after - before).norm(), 1e-12 * before.norm()) << ratio << " " << stiffness << " " << i;
      }
      EXPECT_GT(simulation.states()[0].velocity.norm(), 0.0);
    }
  }
}

/// Balls that meet obliquely, so that the contact's line of action passes through the scene's origin.
TEST(Integrator, ReactionErrorIsRoundingAlsoWhereMomentsVanish) {
  for (const Scheme scheme : kSchemes) {
    for (const double step : {1e-4, 1e-3, 1e-2}) {
      RigidWorld world;
      world.gravity.setZero();
      world.contact.stiffness = 1e8;
      world.bodies = {primitiveBody("a", Sphere{0.05}, 1000.0, 0.01), primitiveBody("b", Sphere{0.05}, 1000.0, 0.01)};
      Simulation simulation(world, {at(Vector3d::Zero()), at({0.06, 0, 0.11 + 0.3 * step}, {0, 0, -1})}, scheme, step);
      for (int i = 0; i < 0.3 / step; ++i) {
        ASSERT_LT(simulation.advance().reaction_error, 1e-13) << toString(scheme) << " " << step << " " << i;
      }
    }
  }
}

TEST(Integrator, BadOptionsAreRefused) {
  EXPECT_THROW(schemeOf("leapfrog"), std::invalid_argument);
  RigidWorld world;
  world.bodies = {pointBody("point", 1.0)};
  world.contact.normal = NormalSource::kShell;
  EXPECT_THROW(makeIntegrator(Scheme::kImplicit, world), std::invalid_argument);
}

}  // namespace sdf_ccd::integrator_test
