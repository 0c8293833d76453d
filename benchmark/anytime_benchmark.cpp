// Error against run time of a running monitor whose cycles have time budgets: error bounds, and verdicts left
// UNCERTAIN.
#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <vector>

#include <tbb/global_control.h>

#include "common/seconds_since.h"
#include "monitor/box_world.h"
#include "monitor/cycle_times.h"
#ifdef SDF_CCD_WITH_ROS
#include "monitor/recorded_poses.h"
#endif
#include "results.h"
#include "sdf_ccd/monitor.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kPeriod = 1e-3;                                        // [s]
constexpr double kBudgets[] = {1, 2, 5, 10, 20, 50, 100, 200, 500, 0};  // [us]; 0: no budget

/// Poses at the start of the first cycle and at the end of every cycle; per time, per body.
using Waypoints = std::vector<std::vector<Isometry3d>>;

/// Results of all cycles with one budget.
struct Said {
  std::vector<double> bounds;  // per cycle: largest error bound of all pairs [m]
  double postponed = 0, open = 0, pair_cycles = 0;
  long false_clear = 0, false_contact = 0;  // compared with the same cycle without a budget
  int longest_wait = 0;                     // largest number of consecutive cycles in which a pair was postponed
};

CycleMotion motionAt(const Waypoints& waypoints, std::size_t cycle) {
  CycleMotion motion;
  motion.times = {0.0, kPeriod};
  for (std::size_t b = 0; b < waypoints[cycle].size(); ++b)
    motion.X_WB.push_back({waypoints[cycle][b], waypoints[cycle + 1][b]});
  return motion;
}

Said listen(Monitor& limited, Monitor& unlimited, const Waypoints& waypoints, const CycleRequest& request) {
  Said said;
  std::vector<int> waited(limited.scene().pairs.size(), 0);
  limited.reset();
  unlimited.reset();
  CycleRequest without = request;
  without.max_time = 0.0;
  for (std::size_t k = 0; k + 1 < waypoints.size(); ++k) {
    const CycleMotion motion = motionAt(waypoints, k);
    const CycleResult &result = limited.run(motion, request), &truth = unlimited.run(motion, without);
    said.bounds.push_back(result.error_bound);
    said.postponed += result.postponed;
    said.pair_cycles += double(result.pairs.size());
    for (std::size_t p = 0; p < result.pairs.size(); ++p) {
      const PairResult &pair = result.pairs[p], &known = truth.pairs[p];
      said.open += pair.verdict == Verdict::kUncertain;
      said.false_clear += pair.verdict == Verdict::kClear && known.verdict == Verdict::kContact;
      said.false_contact += pair.verdict == Verdict::kContact && known.verdict == Verdict::kClear;
      waited[p] = pair.postponed ? waited[p] + 1 : 0;
      said.longest_wait = std::max(said.longest_wait, waited[p]);
    }
  }
  std::sort(said.bounds.begin(), said.bounds.end());
  return said;
}

/// @param described  scene to whose bodies the waypoints belong.
void study(const SceneDescription& described, const Waypoints& waypoints, const std::string& name,
           const StudyOptions& options) {
  MonitorOptions monitor_options;
  const BodyOptions body_options = preparedAsMonitored(monitor_options);
  const auto scene = std::make_shared<const Scene>(
      buildScene(described, planScene(described, planOptions(body_options)), body_options));
  const std::size_t cycles = waypoints.size() - 1;

  Monitor limited(scene, monitor_options), unlimited(scene, monitor_options);
  for (const double budget : kBudgets) {
    CycleRequest request;
    request.max_points = 0;
    request.skipped_pairs = false;
    request.max_time = 1e-6 * budget;
    // Budgets end cycles by the clock, so every run differs: the times of all runs are kept, not their medians.
    CycleTimes times(cycles * std::size_t(options.measure.runs), 1);
    for (int run = 0; run < options.measure.runs; ++run) {
      limited.reset();
      for (std::size_t k = 0; k < cycles; ++k) {
        const CycleMotion motion = motionAt(waypoints, k);
        const auto start = std::chrono::steady_clock::now();
        limited.run(motion, request);
        times.take(std::size_t(run) * cycles + k, secondsSince(start));
      }
    }
    const Said said = listen(limited, unlimited, waypoints, request);
    const std::string of_case = name + "/" + (budget > 0.0 ? std::to_string(int(budget)) : "none");
    const auto row = [&](const char* metric, double value, const char* unit) {
      print({"anytime", of_case, "sdf_ccd", metric, value, unit, options.measure.runs});
    };
    row("us_median", 1e6 * times.quantile(0.5), "us");
    row("us_p99", 1e6 * times.quantile(0.99), "us");
    row("us_p999", 1e6 * times.quantile(0.999), "us");
    row("bound_median", 1e3 * said.bounds[said.bounds.size() / 2], "mm");
    row("bound_p99", 1e3 * said.bounds[said.bounds.size() * 99 / 100], "mm");
    row("open_share", said.open / said.pair_cycles, "of pair-cycles");
    row("postponed", said.postponed / double(said.bounds.size()), "pairs a cycle");
    row("longest_wait", said.longest_wait, "cycles");
    row("false_clear", double(said.false_clear), "pair-cycles");
    row("false_contact", double(said.false_contact), "pair-cycles");
  }
}

/// A robot whose joints swing as in RobotMotion.
void studySeeded(const Robot& robot, Proximity proximity, const std::string& name, const StudyOptions& options) {
  const BoxWorld world = makeBoxWorld(robot, proximity, kPeriod * options.cycles, kSeed);
  Waypoints waypoints;
  for (int k = 0; k <= options.cycles; ++k) waypoints.push_back(world.motion.posesAt(kPeriod * k, world.scene.bodies));
  study(world.scene, waypoints, name, options);
}

#ifdef SDF_CCD_WITH_ROS
/// A robot that moves as recorded in a bag.
void studyRecorded(const Robot& robot, Proximity proximity, const std::string& name, const StudyOptions& options) {
  constexpr std::size_t kLookedAt = 20;  // boxes are placed by the robot's poses at every 20th cycle
  Waypoints waypoints = recordedPoses(options.bag, robot, kPeriod, std::size_t(options.cycles) + 1);
  Waypoints some;
  for (std::size_t k = 0; k < waypoints.size(); k += kLookedAt) some.push_back(waypoints[k]);
  const SceneDescription world = boxesAbout(robot, some, proximity, kSeed);
  for (std::vector<Isometry3d>& X_RB : waypoints) {
    for (std::size_t box = X_RB.size(); box < world.bodies.size(); ++box) X_RB.push_back(world.bodies[box].X_frame_B);
  }
  study(world, waypoints, name, options);
}
#else
void studyRecorded(const Robot&, Proximity, const std::string&, const StudyOptions&) {
  throw std::invalid_argument("--bag: built without ROS");
}
#endif

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.measure.runs = 5;
  full.cycles = 2000;
  StudyOptions quick = full;
  quick.cycles = 500;
  return runStudy(argc, argv, "Cycles with a budget: bound and open verdicts over run time", full, quick,
                  [](const StudyOptions& options) {
                    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
                    for (const std::string& argument : robotsOr(options, "demo=" SDF_CCD_DEMO_ARM)) {
                      const Robot robot = loadRobot(argument);
                      for (const auto& [proximity, what] :
                           {std::pair{Proximity::kNear, "near"}, {Proximity::kContact, "contact"}}) {
                        if (!isWanted(options.cases, what)) continue;
                        if (options.bag.empty()) studySeeded(robot, proximity, robot.name + "/" + what, options);
                        if (!options.bag.empty()) studyRecorded(robot, proximity, robot.name + "_bag/" + what, options);
                      }
                    }
                  });
}
