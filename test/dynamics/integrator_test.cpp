#include "dynamics/integrator.h"

#include <gtest/gtest.h>

#include "oracle/bodies.h"
#include "oracle/persistent_contact.h"
#include "oracle/random.h"

namespace sdf_ccd {
namespace {

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
                  primitiveBody("box", Box{{0.05, 0.08, 0.03}}, 500.0, 0.01)};
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

TEST(Integrator, BadOptionsAreRefused) {
  EXPECT_THROW(schemeOf("leapfrog"), std::invalid_argument);
  RigidWorld world;
  world.bodies = {pointBody("point", 1.0)};
  world.contact.normal = NormalSource::kShell;
  EXPECT_THROW(makeIntegrator(Scheme::kImplicit, world), std::invalid_argument);
}

}  // namespace
}  // namespace sdf_ccd
