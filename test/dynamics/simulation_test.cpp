#include "sdf_ccd/simulation.h"

#include <gtest/gtest.h>

#include "common/infinity.h"
#include "dynamics/collision_shape.h"
#include "oracle/bodies.h"
#include "oracle/failure.h"

namespace sdf_ccd::simulation_test {

using namespace test;

RigidWorld boxOnGround(double stiffness, double damping) {
  RigidWorld world;
  world.bodies = {groundBody(), primitiveBody("box", Box::fromSize({0.1, 0.08, 0.06}), 1000.0, 0.02)};
  world.contact.stiffness = stiffness;
  world.contact.damping = damping;
  return world;
}

BodyState tumbling(double height) {
  return at({0, 0, height}, {0.3, 0.1, 0}, {1.0, -2.0, 3.0});
}

TEST(Simulation, WithoutDampingABouncingBodyGainsNoEnergy) {
  Simulation simulation(boxOnGround(1e8, 0.0), {at(Vector3d::Zero()), tumbling(0.3)}, Scheme::kImplicit, 1e-3);
  double lowest = simulation.last().energy();
  const double scale = lowest;
  for (int i = 0; i < 100000; ++i) {
    const StepRecord& record = simulation.advance();
    ASSERT_LE(record.energy(), lowest + 1e-9 * scale) << i;
    lowest = std::min(lowest, record.energy());
    ASSERT_EQ(record.energy_excess, 0.0) << i;
  }
}

TEST(Simulation, BetweenContactsEnergyStaysWhatItIs) {
  Simulation simulation(boxOnGround(1e7, 1e4), {at(Vector3d::Zero()), tumbling(0.5)}, Scheme::kImplicit, 1e-3);
  double energy = simulation.last().energy();
  int flights = 0;
  for (int i = 0; i < 3000; ++i) {
    const StepRecord& record = simulation.advance();
    EXPECT_LE(record.energy(), energy + 1e-10 * energy) << i;
    if (record.contacts == 0 && record.elastic == 0.0) ++flights;
    energy = record.energy();
  }
  EXPECT_GT(flights, 100);
}

TEST(Simulation, WhatCannotBeSimulatedIsRefusedByName) {
  const auto reasonOf = [](const auto& spoil) {
    RigidWorld world = boxOnGround(1e8, 0.0);
    std::vector<BodyState> states = {at(Vector3d::Zero()), tumbling(0.1)};
    double step = 1e-3;
    spoil(world, states, step);
    return failureOf<std::exception>([&] { Simulation(world, states, Scheme::kImplicit, step); });
  };
  for (const double bad : {0.0, -1.0, kInfinity, std::nan("")}) {
    EXPECT_NE(reasonOf([&](RigidWorld& w, auto&, double&) { w.bodies[1].mass = bad; }).find("`box`, step 0: mass"),
              std::string::npos);
    EXPECT_NE(reasonOf([&](RigidWorld&, auto&, double& step) { step = bad; }).find("time step"), std::string::npos);
  }
  for (const double bad : {-1.0, kInfinity, std::nan("")}) {
    EXPECT_NE(reasonOf([&](RigidWorld& w, auto&, double&) { w.contact.stiffness = bad; }).find("stiffness"),
              std::string::npos);
  }
  EXPECT_NE(reasonOf([](RigidWorld& w, auto&, double&) {
              w.bodies[1].shape = std::make_shared<CollisionShape>();
            }).find("`box`, step 0: has neither a field nor shell points"),
            std::string::npos);
  EXPECT_NE(reasonOf([](RigidWorld& w, auto&, double&) { w.bodies[0].fixed = false; }).find("half-space"),
            std::string::npos);
  EXPECT_NE(reasonOf([](RigidWorld&, std::vector<BodyState>& s, double&) {
              s[1].velocity.x() = kInfinity;
            }).find("velocity is not finite"),
            std::string::npos);
}

TEST(Simulation, ExplosionEndsInAnErrorAndLeavesTheLastGoodState) {
  RigidWorld world = boxOnGround(1e12, 0.0);
  Simulation simulation(world, {at(Vector3d::Zero()), tumbling(0.03)}, Scheme::kDiscrete, 1e-2);
  bool stopped = false;
  for (int i = 0; i < 20000 && !stopped; ++i) {
    try {
      simulation.advance();
    } catch (const SimulationError& error) {
      EXPECT_NE(std::string(error.what()).find("body `box`, step "), std::string::npos);
      stopped = true;
    }
    EXPECT_TRUE(simulation.states()[1].X_OB.matrix().allFinite());
    EXPECT_TRUE(std::isfinite(simulation.last().energy()));
  }
  EXPECT_TRUE(stopped);
}

}  // namespace sdf_ccd::simulation_test
