#include "sdf_ccd/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "oracle/german_locale.h"
#include "oracle/parameter_name.h"

namespace sdf_ccd::simulation_file_test {

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

/// The scene with the ground at (x, 0, z) and the box at height h.
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

TEST(SimulationFile, IsTheSameInEveryLocale) {
  SDF_CCD_NEEDS_GERMAN_LOCALE();
  const test::GermanLocale german;
  const SimulationSetup setup = parseSimulation(placedAt("0", "0", "0.0625"), ".");
  EXPECT_EQ(setup.step, 0.001);
  EXPECT_EQ(setup.duration, 0.5);
  EXPECT_EQ(setup.states[1].velocity, Vector3d(0.5, 0.0, -1.0));
  EXPECT_THROW(parseSimulation(replaced(placedAt("0", "0", "0.0625"), "0.5", "0,5"), "."), std::runtime_error);
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
    return test::failureOf<std::exception>(
        [&] { started(parseSimulation(replaced(placedAt("0", "0", "0.0625"), what, with), "/nowhere")); });
  };
  const auto holds = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  holds(reasonOf("damping", "dampening"), "line 4: unknown parameter contact/dampening, did you mean damping?");
  holds(reasonOf("step: 0.001", "step: quick"), "line 2: parameter step is quick, expected a finite number");
  holds(reasonOf("step: 0.001", "pace: 1"), "parameter step is missing");
  holds(reasonOf("shape: box", "shape: bax"),
        "parameter bodies[1]/shape is bax, expected the name of one of the shapes");
  holds(reasonOf("type: box", "type: bax"), "parameter shapes/box/type is bax, expected one of box sphere");
  holds(reasonOf("type: plane", "type: mesh, file: no.stl"), "/nowhere/no.stl");
  holds(reasonOf("0.0625], spacing", "-1], spacing"),
        "parameter shapes/box/size is [0.1, 0.08, -1], expected three positive numbers");
  holds(reasonOf("size: [0.1, ", "size: ["), "expected three finite numbers");
  holds(reasonOf("step: 0.001", "step: [}"), "line 2");
  holds(reasonOf("step: 0.001", "step: 0"), "time step must be finite and positive");
  holds(reasonOf("step: 0.001", "step: .inf"), "line 2: parameter step is .inf");
  holds(reasonOf("shape: box", "shape: box, mass: -2"), "body `box`, step 0: mass must be finite and positive, got -2");
  holds(reasonOf("shape: box", "shape: box, mass: .nan"), "line 10: parameter bodies[1]/mass is .nan");
  holds(reasonOf("stiffness: 1.0e+8", "stiffness: -1"),
        "line 4: parameter contact/stiffness is -1, expected a non-negative number");
  for (const char* count : {"0", "2000000000"}) {
    holds(reasonOf("damping: 1.0e+4", std::string("quadrature: midpoint, midpoint_intervals: ") + count),
          std::string("line 4: parameter contact/midpoint_intervals is ") + count +
              ", expected an integer from 1 to 10000");
  }
  holds(reasonOf("damping: 1.0e+4", "stiffness: 1"), "line 4: parameter stiffness is set twice");
  holds(reasonOf("0.02}", "0.02, traversal: foo}"), "line 6: parameter shapes/box/traversal is foo");
  holds(reasonOf("spacing: 0.02", "spacing: 0"), "line 6: parameter shapes/box/spacing is 0");
  holds(reasonOf("type: plane", "type: blob, radius: 1, points: -1"),
        "points is -1, expected an integer from 4 to 1000000");
  holds(reasonOf("type: plane", "type: bowl, radius: 1, thickness: 0.1, steps: 1000000000"),
        "expected an integer from 3 to 1000");
  holds(reasonOf("shape: box", "shape: box, mass: 1, density: 2"),
        "line 10: parameter bodies[1]/mass is 1, expected only one of mass and density");
  holds(reasonOf("velocity: [0.5, 0, -1]", "repeat: {count: [1.5, 1, 1], spacing: [1, 1, 1]}"), "whole numbers");
  holds(reasonOf("velocity: [0.5, 0, -1]", "repeat: {count: [1000, 1000, 1000], spacing: [1, 1, 1]}"), "at most 5000");
  holds(reasonOf("velocity: [0.5, 0, -1]", "repeat: {count: [5000, 1, 1], spacing: [1, 1, 1]}"), "at most 5000 bodies");
  holds(reasonOf("velocity: [0.5, 0, -1]", "velocity: [0, 0, -1.0e+160]"),
        "body `box`, step 0: its energy or momentum");
  holds(reasonOf("0.0625], rpy", "1.0e+12], rpy"),
        "line 10: parameter bodies[1]/xyz is [0, 0.25, 1e+12], expected a position at most 1e+08 m");
  for (const char* name : {"\"\"", "\"a,b\"", "\"a\\nb\"", "/a", "world"}) {
    holds(reasonOf("name: box", std::string("name: ") + name), "line 10: parameter bodies[1]/name");
  }
  holds(reasonOf("name: box", "name: ground"), "line 10: parameter bodies[1]/name is ground");
}

TEST(SimulationFile, ShapesAreAMapAndBodiesAList) {
  const auto reasonOf = [](const std::string& rest) {
    return test::failureOf<std::exception>([&] { parseSimulation("step: 0.001\nduration: 1\n" + rest, "."); });
  };
  EXPECT_EQ(reasonOf("shapes: [1, 2]\nbodies: []"),
            "line 3: parameter shapes is [1, 2], expected a group of parameters");
  EXPECT_EQ(reasonOf("shapes: {}\nbodies: []"), "line 4: parameter bodies is [], expected a list of at least one body");
  for (const char* bodies : {"", "3", "{name: ball}"}) {
    EXPECT_EQ(reasonOf(std::string("shapes: {}\nbodies: ") + bodies).find("line 4: parameter bodies "), 0u) << bodies;
  }
}

/// A cube of 1 m without its lid.
TEST(SimulationFile, AnOpenMeshHasNoMassOfItsOwnAndIsWarnedOf) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "open_cube.off";
  std::ofstream(file) << "OFF\n8 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                         "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  const auto scene = [&](const std::string& more) {
    return parseSimulation("step: 0.001\nduration: 1\nshapes: {cup: {type: mesh, cells: 16, file: " + file.string() +
                               "}}\nbodies: [{name: cup, shape: cup, " + more + "}]",
                           ".");
  };
  const std::string failure = test::failureOf<SimulationError>([&] { scene("density: 1000"); });
  EXPECT_NE(failure.find("body `cup`, step 0: its shape is not closed"), std::string::npos) << failure;
  for (const char* more : {"fixed: true", "mass: 1, inertia: [1, 1, 1]"}) {
    const SimulationSetup setup = scene(more);
    ASSERT_EQ(setup.warnings.size(), 1u) << more;
    EXPECT_NE(setup.warnings[0].find("body `cup`"), std::string::npos);
  }
  EXPECT_EQ(scene("mass: 1, inertia: [1, 1, 1]").world.bodies[0].mass, 1.0);
}

/// The shipped scenes: they load, action equals reaction, and energy never increases.
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

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, ::testing::Values("drop", "bowls", "stack", "top", "wedge", "nut", "pile"),
                         test::ParameterName());

}  // namespace sdf_ccd::simulation_file_test
