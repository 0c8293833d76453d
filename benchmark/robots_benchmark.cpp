// What a robot's max_error costs in memory, start-up and cycle time, and what verdicts it leaves open.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "common/seconds_since.h"
#include "monitor/scene_cost.h"
#include "results.h"
#include "robot_case.h"
#include "sdf_ccd/monitor/monitor.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

/// A cycle from one pose of the robot towards another, as far as it turns by 0.02 rad or moves by 2 cm.
CycleMotion shortCycle(const Robot& robot, const Scene& scene, const JointPositions& from, const JointPositions& to) {
  constexpr double kStep = 0.02;
  JointPositions next = from;
  for (auto& [name, position] : next) position += std::clamp(to.at(name) - position, -kStep, kStep);
  const auto start = robot.model.forwardKinematics(from), end = robot.model.forwardKinematics(next);
  CycleMotion motion;
  motion.times = {0.0, 1.0 / 30.0};
  const std::vector<std::string>& links = robot.model.links();
  for (const Body& body : scene.bodies) {
    const std::size_t link = std::find(links.begin(), links.end(), body.frame) - links.begin();
    motion.X_WB.push_back({start[link], end[link]});
  }
  return motion;
}

void study(const Robot& robot, double max_error, const StudyOptions& options) {
  MonitorOptions monitor_options;
  monitor_options.max_error = max_error;
  const BodyOptions scene_options = preparedAsMonitored(monitor_options);
  const ScenePlan plan = planScene(robot.scene, planOptions(scene_options));
  const SceneCost expected = expectedCost(robot.scene, plan, scene_options);
  const auto start = Clock::now();
  const auto scene = std::make_shared<const Scene>(buildScene(robot.scene, plan, scene_options));
  const double build_seconds = secondsSince(start);
  std::fprintf(stderr, "%s", planTable(*scene).c_str());
  double bytes = 0.0;
  for (const BodyReport& report : scene->reports) bytes += double(report.field_bytes + report.shell_bytes);

  Monitor monitor(scene, monitor_options);
  std::mt19937_64 random(1);
  std::vector<double> milliseconds;
  double bound = 0.0, verdicts[4] = {};
  for (int i = 0; i < options.pairs; ++i) {
    const JointPositions from = randomPositions(robot.model, random), to = randomPositions(robot.model, random);
    monitor.reset();
    const CycleResult& result = monitor.run(shortCycle(robot, *scene, from, to), {});
    milliseconds.push_back(1e3 * result.run_time);
    bound = std::max(bound, result.error_bound);
    for (const PairResult& pair : result.pairs) ++verdicts[static_cast<int>(pair.verdict)];
  }
  std::nth_element(milliseconds.begin(), milliseconds.begin() + milliseconds.size() / 2, milliseconds.end());
  const double pairs = double(scene->pairs.size()) * options.pairs;
  char name[64];
  std::snprintf(name, sizeof name, "%s/%ldum", robot.name.c_str(), std::lround(1e6 * max_error));
  const auto row = [&](const char* metric, double value, const char* unit) {
    print({"robots", name, "sdf_ccd", metric, value, unit, options.pairs});
  };
  row("bound", 1e3 * bound, "mm");
  row("memory", 1e-6 * bytes, "MB");
  row("expected_memory", 1e-6 * expected.bytes, "MB");
  row("build", build_seconds, "s");
  row("expected_build", expected.seconds, "s");
  row("cycle", milliseconds[milliseconds.size() / 2], "ms");
  row("uncertain", 100.0 * verdicts[static_cast<int>(Verdict::kUncertain)] / pairs, "%");
  row("contact", 100.0 * verdicts[static_cast<int>(Verdict::kContact)] / pairs, "%");
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.errors = {"0.01", "0.003", "0.001", "0.0003", "0.0001", "0.00003", "0.00001"};
  StudyOptions quick = full;
  quick.errors = {"0.01", "0.0001"};
  quick.pairs = 100;
  return runStudy(argc, argv, "A robot's max_error against memory, start-up and cycle time", full, quick,
                  [](const StudyOptions& options) {
                    for (const std::string& argument : options.robots) {
                      const Robot robot = loadRobot(argument);
                      for (const std::string& error : options.errors) study(robot, std::stod(error), options);
                    }
                  });
}
