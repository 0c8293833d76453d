// Memory, start-up time, cycle time and undecided verdicts over a robot's max_error; cost and force errors over
// contact/accuracy.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <random>
#include <tuple>

#include "common/seconds_since.h"
#include "monitor/robot_motion.h"
#include "oracle/random.h"
#include "precision/error_summary.h"
#include "results.h"
#include "robot_case.h"
#include "scene/error_budget.h"
#include "sdf_ccd/monitor.h"
#include "sdf_ccd/robot.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

/// A cycle from one pose of the robot towards another, in which each joint moves by at most 0.02 rad or 2 cm.
/// @param error  of the motion of each of the robot's bodies [m].
CycleMotion shortCycle(const Robot& robot, const JointPositions& from, const JointPositions& to, double error) {
  constexpr double kStep = 0.02;
  JointPositions next = from;
  for (auto& [name, position] : next) position += std::clamp(to.at(name) - position, -kStep, kStep);
  const std::vector<BodyDescription>& bodies = robot.scene.bodies;
  const auto start = posesAt(robot.model, from, bodies), end = posesAt(robot.model, next, bodies);
  CycleMotion motion;
  motion.times = {0.0, 1.0 / 30.0};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    motion.X_WB.push_back({start[b], end[b]});
    motion.motion_error.push_back(bodies[b].is_world ? 0.0 : error);
  }
  return motion;
}

/// The robot among thirty boxes, a hand's breadth to half a metre from where its links' frames are in random poses.
Robot amongBoxes(Robot robot) {
  constexpr int kBoxes = 30;
  test::Random random(2);
  for (int i = 0; i < kBoxes; ++i) {
    const auto X_RB = posesAt(robot.model, randomPositions(robot.model, random), robot.scene.bodies);
    Isometry3d X_RO = test::pose(random, 3.0, 0.0);
    X_RO.translation() =
        X_RB[random() % X_RB.size()].translation() + test::uniform(random, 0.1, 0.5) * test::direction(random);
    BodyDescription box = randomBox(robot, i, random);
    box.X_frame_B = X_RO;
    robot.scene.bodies.push_back(box);
  }
  setRigidRoots(robot.model, robot.scene);
  return robot;
}

struct Checked {
  std::shared_ptr<const Scene> scene;
  double build_seconds = 0.0, bytes = 0.0, bound = 0.0;  // the largest bound [m]
  std::vector<double> milliseconds;                      // per cycle
  std::vector<Verdict> verdicts;                         // per cycle and pair
  std::vector<Vector3d> forces_W;                        // on body A, per cycle and pair [N]

  double medianCycle() { return precision::quantile(milliseconds, 0.5); }
};

/// Prepares a robot and checks random short cycles, the same ones in every call.
/// @param motion_error  of each of the robot's bodies [m].
Checked check(const Robot& robot, const BodyOptions& prepared, const MonitorOptions& monitor_options, int cycles,
              double motion_error = 0.0) {
  Checked checked;
  const ScenePlan plan = planScene(robot.scene, planOptions(prepared));
  const auto start = Clock::now();
  checked.scene = std::make_shared<const Scene>(buildScene(robot.scene, plan, prepared));
  checked.build_seconds = secondsSince(start);
  std::fprintf(stderr, "%s", planTable(*checked.scene).c_str());
  for (const BodyReport& report : checked.scene->reports)
    checked.bytes += double(report.field_bytes + report.shell_bytes);

  Monitor monitor(checked.scene, monitor_options);
  std::mt19937_64 random(1);
  for (int i = 0; i < cycles; ++i) {
    const JointPositions from = randomPositions(robot.model, random), to = randomPositions(robot.model, random);
    monitor.reset();
    const CycleResult& result = monitor.run(shortCycle(robot, from, to, motion_error), {});
    checked.milliseconds.push_back(1e3 * result.run_time);
    checked.bound = std::max(checked.bound, result.error_bound);
    for (const PairResult& pair : result.pairs) {
      checked.verdicts.push_back(pair.verdict);
      checked.forces_W.push_back(pair.on_a_W.force);
    }
  }
  return checked;
}

void printCost(const std::string& name, Checked& checked) {
  const auto row = [&](const char* metric, double value, const char* unit) {
    print({"robots", name, "sdf_ccd", metric, value, unit, int(checked.milliseconds.size())});
  };
  row("memory", 1e-6 * checked.bytes, "MB");
  row("build", checked.build_seconds, "s");
  row("cycle", checked.medianCycle(), "ms");
}

void studyMaxError(const Robot& robot, double max_error, const StudyOptions& options) {
  MonitorOptions monitor_options;
  monitor_options.max_error = max_error;
  // As large as the nodelet allows the error between two transforms to be.
  const double motion_error = samplingTolerance(max_error, monitor_options.chords.tolerance);
  Checked checked = check(robot, preparedAsMonitored(monitor_options), monitor_options, options.pairs, motion_error);
  char name[64];
  std::snprintf(name, sizeof name, "%s/%ldum", robot.name.c_str(), std::lround(1e6 * max_error));
  printCost(name, checked);
  const auto row = [&](const char* metric, double value, const char* unit) {
    print({"robots", name, "sdf_ccd", metric, value, unit, options.pairs});
  };
  const auto share = [&](Verdict verdict) {
    const auto count = std::count(checked.verdicts.begin(), checked.verdicts.end(), verdict);
    return 100.0 * double(count) / double(checked.verdicts.size());
  };
  row("bound", 1e3 * checked.bound, "mm");
  row("uncertain", share(Verdict::kUncertain), "%");
  row("contact", share(Verdict::kContact), "%");
}

/// Relative errors of forces against those of a finer scene, and number of verdicts that differ.
void studyAccuracy(const Robot& robot, const StudyOptions& options) {
  constexpr double kFinest = 0.00125;  // the reference [m]
  const MonitorOptions monitor_options;
  const auto checkAt = [&](const std::optional<double>& accuracy) {
    BodyOptions prepared = preparedAsMonitored(monitor_options);
    const BodyOptions wanted = optionsForContacts(accuracy);
    std::tie(prepared.field, prepared.shell) = std::tie(wanted.field, wanted.shell);
    std::tie(prepared.points_across, prepared.cells_across) = std::tie(wanted.points_across, wanted.cells_across);
    return check(robot, prepared, monitor_options, options.pairs);
  };
  const Checked reference = checkAt(kFinest);
  const std::vector<std::optional<double>> accuracies{0.04, 0.02, 0.01, 0.005, std::nullopt, 0.0025};
  for (const std::optional<double>& accuracy : accuracies) {
    Checked checked = checkAt(accuracy);
    const std::string name =
        robot.name + "/accuracy_" + (accuracy ? std::to_string(std::lround(1e6 * *accuracy)) + "um" : "default");
    printCost(name, checked);
    std::vector<double> errors;
    double difference = 0.0, all_forces = 0.0;
    long others = 0;
    for (std::size_t i = 0; i < reference.verdicts.size(); ++i) {
      others += checked.verdicts[i] != reference.verdicts[i];
      const double force = reference.forces_W[i].norm();
      difference += (checked.forces_W[i] - reference.forces_W[i]).norm();
      all_forces += force;
      if (force > 0.0) errors.push_back((checked.forces_W[i] - reference.forces_W[i]).norm() / force);
    }
    const auto quantile = [&](double q) { return errors.empty() ? 0.0 : precision::quantile(errors, q); };
    const auto row = [&](const char* metric, double value, const char* unit) {
      print({"robots", name, "sdf_ccd", metric, value, unit, int(errors.size())});
    };
    row("force_error_median", 100.0 * quantile(0.5), "%");
    row("force_error_p90", 100.0 * quantile(0.9), "%");
    row("force_error_all", all_forces > 0.0 ? 100.0 * difference / all_forces : 0.0, "%");
    row("other_verdicts", double(others), "pairs");
  }
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
  return runStudy(argc, argv, "A robot's max_error and contact/accuracy against memory, start-up and cycle time", full,
                  quick, [](const StudyOptions& options) {
                    for (const std::string& argument : options.robots) {
                      const Robot robot = loadRobot(argument);
                      if (isWanted(options.cases, "max_error")) {
                        const Robot placed = amongBoxes(robot);
                        for (const std::string& error : options.errors)
                          studyMaxError(placed, std::stod(error), options);
                      }
                      if (isWanted(options.cases, "accuracy")) studyAccuracy(robot, options);
                    }
                  });
}
