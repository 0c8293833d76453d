#include <gtest/gtest.h>

#include "tools/tool_run.h"

namespace sdf_ccd::simulate_command_test {

using namespace test;
using Tool = ToolWithBall;

TEST_F(Tool, SimulateWritesStepsPosesAndASummary) {
  write("scene.yaml",
        "step: 0.001\nduration: 0.2\nshapes: {ball: {type: sphere, radius: 0.1}, ground: {type: plane}}\n"
        "bodies: [{name: ground, shape: ground, fixed: true}, {name: ball, shape: ball, xyz: [0, 0, 0.11]}]\n");
  const ToolRun result = run("simulate scene.yaml --out made --frames 10");
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_NE(result.out.find("steps            200 (0.2 s)"), std::string::npos) << result.out;
  EXPECT_EQ(readText(path("made/summary.txt")), result.out);
  const std::string steps = readText(path("made/steps.csv")), poses = readText(path("made/poses.csv"));
  EXPECT_EQ(std::count(steps.begin(), steps.end(), '\n'), 202);
  EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 1 + 2 * 3);
  EXPECT_EQ((steps + poses).find("nan"), std::string::npos);
  expectRefused("simulate no.yaml --out no", "no.yaml: cannot be opened");
  expectRefused("simulate scene.yaml --out no --integrator leapfrog", "leapfrog");
  for (const char* step : {"-1", "0"}) {
    expectRefused(std::string("simulate scene.yaml --out no --step ") + step, "time step must be");
  }
  expectRefused("simulate scene.yaml --out no --duration 0", "duration / step must be 1 to 1e9 steps");
  expectRefused("simulate . --out no", "is a directory");
}

TEST_F(Tool, SimulateWarnsOfEnergyThatGrew) {
  write("scene.yaml",
        "step: 0.001\nduration: 0.3\ncontact: {stiffness: 1.0e+12}\n"
        "shapes: {box: {type: box, size: [0.1, 0.1, 0.1]}, ground: {type: plane}}\n"
        "bodies: [{name: ground, shape: ground, fixed: true}, {name: box, shape: box, xyz: [0, 0, 0.3]}]\n");
  for (const char* integrator : {"discrete", "implicit"}) {
    const ToolRun result = run(std::string("simulate scene.yaml --out made --integrator ") + integrator);
    EXPECT_EQ(result.exit_code, kDone) << result.error;
    const bool warns = result.out.find("warning          the energy grew from 2.94 J to ") != std::string::npos;
    EXPECT_EQ(warns, std::string(integrator) == "discrete") << result.out;
  }
}

TEST_F(Tool, InterruptedSimulationKeepsWhatItHas) {
  write("scene.yaml",
        "step: 0.001\nduration: 1.0e+5\ngravity: [0, 0, 0]\nshapes: {ball: {type: sphere, radius: 0.1}}\n"
        "bodies: [{name: ball, shape: ball}]\n");
  const std::string script = "cd '" + path("").string() +
                             "' && { '" SDF_CCD_TOOL
                             "' simulate scene.yaml --out made > ../out.txt 2> ../progress.txt & "
                             "for i in $(seq 300); do grep -qs simulation: ../progress.txt && break; sleep 0.1; done; "
                             "sleep 0.2; kill -INT $!; wait $!; }";
  const int status = std::system(script.c_str());
  EXPECT_EQ(WEXITSTATUS(status), kPartlyDone);
  EXPECT_NE(readText(path("made/summary.txt")).find("interrupted after step"), std::string::npos);
  const std::string steps = readText(path("made/steps.csv"));
  EXPECT_EQ(steps.back(), '\n');
  for (const fs::directory_entry& file : fs::directory_iterator(path("made"))) {
    const std::string extension = file.path().extension().string();
    EXPECT_TRUE(extension == ".csv" || extension == ".txt" || extension == ".bag") << file.path();
  }
}

TEST_F(Tool, SimulationThatCannotGoOnKeepsWhatItHas) {
  write("scene.yaml",
        "step: 0.01\nduration: 1\nshapes: {box: {type: box, size: [0.1, 0.2, 0.3]}}\n"
        "bodies: [{name: brick, shape: box, mass: 1, force: [1.0e+13, 0, 0]}]\n");
  const ToolRun result = run("simulate scene.yaml --out made");
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("body `brick`, step 2: it would move 1.5e+09 m in one step"), std::string::npos)
      << result.error;
  const std::string steps = readText(path("made/steps.csv"));
  EXPECT_EQ(std::count(steps.begin(), steps.end(), '\n'), 3);
  EXPECT_EQ(steps.find("nan"), std::string::npos);
  EXPECT_EQ(steps.find("inf"), std::string::npos);
}

}  // namespace sdf_ccd::simulate_command_test
