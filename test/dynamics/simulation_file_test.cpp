#include "sdf_ccd/dynamics/simulation_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace sdf_ccd {
namespace {

constexpr char kBoxOnPlane[] = R"(
step: 0.001
duration: 0.5
contact: {stiffness: 1.0e+8, damping: 1.0e+4}
shapes:
  box: {type: box, size: [0.1, 0.08, 0.0625], spacing: 0.02}
  ground: {type: plane}
bodies:
  - {name: ground, shape: ground, fixed: true, xyz: [X, 0, Z]}
  - {name: box, shape: box, xyz: [X, 0.25, H], rpy: [0.5, 0.25, 0], velocity: [0.5, 0, -1]}
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) {
    text.replace(at, what.size(), with);
  }
  return text;
}

/// The ground at (x, 0, z), the box at the height h.
std::string placedAt(const std::string& x, const std::string& z, const std::string& h) {
  return replaced(replaced(replaced(kBoxOnPlane, "X", x), "Z", z), "H", h);
}

Simulation started(const SimulationSetup& setup) {
  return Simulation(setup.world, setup.states, setup.scheme, setup.step);
}

TEST(SimulationFile, AMillionMetresAwayContactIsTheSameToTheLastBit) {
  Simulation near = started(parseSimulation(placedAt("0", "0", "0.0625"), "."));
  const SimulationSetup there = parseSimulation(placedAt("1000000", "-1000000", "-999999.9375"), ".");
  EXPECT_EQ(there.world.origin_W, Vector3d(1e6, 0, -1e6));
  Simulation far = started(there);
  int contacts = 0;
  for (int i = 0; i < 500; ++i) {
    contacts += near.advance().contacts > 0;
    far.advance();
  }
  EXPECT_GT(contacts, 50);
  EXPECT_EQ((near.states()[1].X_OB.matrix() - far.states()[1].X_OB.matrix()).norm(), 0.0);
}

TEST(SimulationFile, RepeatMakesCopiesThatShareAShape) {
  const std::string text = replaced(placedAt("0", "0", "0.0625"), "velocity: [0.5, 0, -1]",
                                    "repeat: {count: [2, 3, 1], spacing: [0.5, 0.25, 0], jitter: 0.01, tumble: true}");
  const SimulationSetup setup = parseSimulation(text, ".");
  ASSERT_EQ(setup.world.bodies.size(), 7u);
  EXPECT_EQ(setup.world.bodies[6].name, "box/5");
  EXPECT_EQ(setup.world.bodies[6].shape, setup.world.bodies[1].shape);
  EXPECT_NEAR(setup.states[6].X_OB.translation().x(), 0.5, 0.0101);
  EXPECT_EQ(parseSimulation(text, ".").states[6].X_OB.matrix(), setup.states[6].X_OB.matrix());
}

TEST(SimulationFile, MistakesAreNamedWithTheirLine) {
  const auto reasonOf = [](const std::string& what, const std::string& with) {
    try {
      started(parseSimulation(replaced(placedAt("0", "0", "0.0625"), what, with), "/nowhere"));
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto holds = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  holds(reasonOf("damping", "dampening"), "line 4, contact: `dampening` is not known here");
  holds(reasonOf("step: 0.001", "step: quick"), "line 2, scene: `step` cannot be \"quick\"");
  holds(reasonOf("step: 0.001", "pace: 1"), "`step` is missing");
  holds(reasonOf("shape: box", "shape: bax"), "there is no shape `bax`");
  holds(reasonOf("type: box", "type: bax"), "type `bax` is not known");
  holds(reasonOf("type: plane", "type: mesh, file: no.stl"), "/nowhere/no.stl");
  holds(reasonOf("0.0625], spacing", "-1], spacing"), "shape `box`: a box's half size");
  holds(reasonOf("size: [0.1, ", "size: ["), "three numbers are wanted");
  holds(reasonOf("step: 0.001", "step: [}"), "line 2");
  holds(reasonOf("step: 0.001", "step: 0"), "time step must be finite and positive");
  holds(reasonOf("step: 0.001", "step: .inf"), "time step must be finite and positive");
  holds(reasonOf("shape: box", "shape: box, mass: -2"), "body `box`, step 0: mass must be finite and positive, got -2");
  holds(reasonOf("shape: box", "shape: box, mass: .nan"), "body `box`, step 0: mass");
  holds(reasonOf("stiffness: 1.0e+8", "stiffness: -1"), "stiffness must be finite and not negative");
}

/// The scenes that are shipped: they load, action equals reaction, and energy never rises.
class ShippedScene : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedScene, KeepsItsReactionsAndItsEnergy) {
  const std::string directory = SDF_CCD_SOURCE_DIR "/config/scenes/";
  Simulation simulation = started(loadSimulation(directory + GetParam() + ".yaml"));
  double energy = simulation.last().energy();
  int contacts = 0;
  for (int i = 0; i < 1000 && contacts < 60; ++i) {
    const StepRecord& record = simulation.advance();
    contacts += record.contacts > 0;
    ASSERT_LT(record.reaction_error, 1e-10) << record.step;
    ASSERT_LE(record.energy(), energy + 1e-9 * std::abs(energy)) << record.step;
    energy = record.energy();
  }
  EXPECT_GE(contacts, 60);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, ::testing::Values("drop", "bowls", "stack", "top", "wedge", "nut", "pile"));

}  // namespace
}  // namespace sdf_ccd
