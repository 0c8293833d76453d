// Time of a whole cycle of the monitor, from poses to its result, compared with other libraries on the same poses and
// pairs.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <functional>

#include <tbb/global_control.h>

#include "common/seconds_since.h"
#include "monitor/box_world.h"
#include "monitor/cycle_times.h"
#include "monitor/fcl_scene.h"
#include "monitor/monitor_system.h"
#include "monitor/sdf_ccd_monitor.h"
#include "results.h"
#include "sdf_ccd/monitor.h"
#include "study.h"
#ifdef SDF_CCD_WITH_ROS
#include "monitor/tf_cycles.h"
#endif

namespace sdf_ccd::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSecondsPerRun = 2.0;   // of a system; slower ones run only every n-th cycle
constexpr double kWarmUp = 0.02;         // before each run: the system before it has filled the caches [s]
constexpr int kTruthPoses = 10;          // at which FCL checks a verdict within a cycle
constexpr std::size_t kColdCycles = 40;  // of a system
constexpr std::uint64_t kSeed = 1;

/// Poses at the start of the first cycle and at the end of every cycle.
struct Waypoints {
  double period;  // [s]
  std::vector<std::vector<Isometry3d>> X_WB;

  std::size_t cycles() const { return X_WB.size() - 1; }
};

Waypoints waypointsOf(const BoxWorld& world, double rate, std::size_t cycles) {
  Waypoints waypoints{1.0 / rate, {}};
  for (std::size_t k = 0; k <= cycles; ++k)
    waypoints.X_WB.push_back(world.motion.posesAt(double(k) / rate, world.scene.bodies));
  return waypoints;
}

CycleRequest withContacts(bool wrenches) {
  CycleRequest request;
  request.wrenches = wrenches;
  request.skipped_pairs = false;
  return request;
}

/// Prints the reported error bounds of the deepest points' depths, over all contacts of all cycles.
void printDepthErrors(SdfCcdMonitor& system, const Waypoints& waypoints, const std::string& name) {
  system.reset();
  std::vector<double> errors;
  double measured = 0.0;
  for (std::size_t i = 0; i < waypoints.cycles(); ++i) {
    system.take(waypoints.X_WB[i], waypoints.X_WB[i + 1]);
    for (const PairResult& pair : system.run().pairs) {
      if (pair.verdict != Verdict::kContact || pair.skipped || pair.intervals.empty()) continue;
      measured += pair.measured;
      errors.push_back(pair.deepest.depth_error);
    }
  }
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  const auto row = [&](const char* metric, double share) {
    const double error = errors[static_cast<std::size_t>(share * double(errors.size() - 1))];
    print({"monitor", name, system.name(), metric, 1e3 * error, "mm", 1});
  };
  row("depth_error_median", 0.5);
  row("depth_error_p99", 0.99);
  print({"monitor", name, system.name(), "measured", measured / double(errors.size()), "of contacts", 1});
}

/// Counts of verdicts over all cycles, and of those that FCL contradicts.
struct Verdicts {
  double bound = 0.0;  // largest [m]
  long pair_cycles = 0, uncertain = 0, contact = 0, false_clear = 0, checked = 0;
};

Verdicts verdictsOf(SdfCcdMonitor& ours, const SceneDescription& scene, const Waypoints& waypoints) {
  FclScene fcl(scene.bodies);
  Verdicts verdicts;
  std::vector<int> clear;
  ours.reset();
  for (std::size_t k = 0; k < waypoints.cycles(); ++k) {
    ours.take(waypoints.X_WB[k], waypoints.X_WB[k + 1]);
    const CycleResult& result = ours.run();
    verdicts.bound = std::max(verdicts.bound, result.error_bound);
    verdicts.checked += result.checked;
    verdicts.pair_cycles += static_cast<long>(result.pairs.size());
    clear.clear();
    for (std::size_t i = 0; i < result.pairs.size(); ++i) {
      const Verdict verdict = result.pairs[i].verdict;
      verdicts.uncertain += verdict == Verdict::kUncertain;
      verdicts.contact += verdict == Verdict::kContact;
      if (verdict == Verdict::kClear) clear.push_back(static_cast<int>(i));
    }
    std::vector<ScrewMotion> screws;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      screws.emplace_back(waypoints.X_WB[k][b], waypoints.X_WB[k + 1][b]);
    for (int pose = 1; pose <= kTruthPoses; ++pose) {
      for (std::size_t b = 0; b < screws.size(); ++b)
        fcl.move(static_cast<int>(b), screws[b].pose(double(pose) / kTruthPoses));
      const auto touches = [&](int i) {
        const PairResult& pair = result.pairs[static_cast<std::size_t>(i)];
        return fcl.collide(pair.body_a, pair.body_b);
      };
      const auto first = std::stable_partition(clear.begin(), clear.end(), [&](int i) { return !touches(i); });
      verdicts.false_clear += clear.end() - first;
      clear.erase(first, clear.end());
    }
  }
  return verdicts;
}

/// Stride over the cycles for which a run of the system takes about kSecondsPerRun.
std::size_t strideFor(MonitorSystem& system, const Waypoints& waypoints) {
  constexpr std::size_t kProbes = 20;
  const auto start = Clock::now();
  const std::size_t step = std::max<std::size_t>(1, waypoints.cycles() / kProbes);
  std::size_t probed = 0;
  for (std::size_t k = 0; k < waypoints.cycles(); k += step, ++probed)
    system.check(waypoints.X_WB[k], waypoints.X_WB[k + 1]);
  const double seconds = secondsSince(start) / double(probed) * double(waypoints.cycles());
  return std::max<std::size_t>(1, static_cast<std::size_t>(seconds / kSecondsPerRun));
}

/// Runs cycles that are not timed, in turn from the first.
void warmUp(const std::function<void(std::size_t)>& cycle, std::size_t cycles) {
  const auto start = Clock::now();
  for (std::size_t i = 0; i == 0 || secondsSince(start) < kWarmUp; ++i) cycle(i % cycles);
}

/// A scene, built once for motions at several rates.
struct Built {
  std::string name;
  const Robot* robot;
  BoxWorld world;
  std::shared_ptr<const Scene> scene;
  MonitorOptions options;
};

Built build(const Robot& robot, const BoxWorld& world, const std::string& name, double max_error) {
  Built built{name, &robot, world, nullptr, {}};
  if (max_error > 0.0) built.options.max_error = max_error;
  BodyOptions options = preparedAsMonitored(built.options);
  const auto start = Clock::now();
  built.scene = std::make_shared<const Scene>(
      buildScene(built.world.scene, planScene(built.world.scene, planOptions(options)), options));
  const double build_seconds = secondsSince(start);
  double bytes = 0.0;
  for (const BodyReport& report : built.scene->reports) bytes += double(report.field_bytes + report.shell_bytes);
  const auto row = [&](const char* metric, double value, const char* unit) {
    print({"monitor", name, "sdf_ccd", metric, value, unit, 1});
  };
  row("pairs", double(built.scene->pairs.size()), "pairs");
  row("start_up", build_seconds, "s");
  row("memory", 1e-6 * bytes, "MB");
  return built;
}

/// Overwrites the processor's caches, as other programs do between the cycles of a robot.
void fillCaches() {
  static std::vector<std::uint64_t> other(std::size_t{1} << 23);  // 64 MB
  for (std::uint64_t& word : other) word = word * 3 + 1;
}

/// Times of single cycles that begin with cold caches. The monitor runs those between them too, with warm ones: it
/// skips pairs by earlier cycles.
void studyColdCaches(MonitorSystem& system, const Waypoints& waypoints, bool needs_all, const std::string& name) {
  const std::size_t stride = std::max<std::size_t>(1, waypoints.cycles() / kColdCycles);
  CycleTimes times(waypoints.cycles(), stride);
  for (std::size_t i = 0; i < waypoints.cycles(); i += needs_all ? 1 : stride) {
    const bool is_cold = i % stride == 0;
    if (is_cold) fillCaches();
    const auto start = Clock::now();
    system.check(waypoints.X_WB[i], waypoints.X_WB[i + 1]);
    if (is_cold) times.take(i, secondsSince(start));
  }
  print({"monitor", name, system.name(), "us_cold_median", 1e6 * times.quantile(0.5), "us", 1});
}

#ifdef SDF_CCD_WITH_ROS
/// Times of whole cycles from tf to the message, and of their parts outside the monitor.
void studyTransforms(const Built& built, double period, std::size_t cycles, const std::string& name, int runs) {
  TfCycles system(*built.robot, built.world, built.scene, built.options, period);
  CycleTimes whole(cycles, 1), beside(cycles, 1);
  for (int run = 0; run < runs; ++run) {
    for (std::size_t i = 0; i < cycles; ++i) {
      system.prepare(i);
      const auto start = Clock::now();
      system.run();
      const double seconds = secondsSince(start);
      whole.take(i, seconds);
      beside.take(i, seconds - system.monitorSeconds());
    }
  }
  for (const auto& [times, what] : {std::pair{&whole, "us"}, {&beside, "beside_us"}}) {
    for (const auto& [quantile, share] : {std::pair{"_median", 0.5}, {"_p99", 0.99}, {"_p999", 0.999}})
      print({"monitor", name, "sdf_ccd_tf", std::string(what) + quantile, 1e6 * times->quantile(share), "us", runs});
  }
  print({"monitor", name, "sdf_ccd_tf", "transforms", double(system.transformsPerMessage()), "a message", 1});
}
#endif

void study(const Built& built, double rate, const std::string& name, const StudyOptions& options) {
  const Waypoints waypoints =
      waypointsOf(built.world, rate, static_cast<std::size_t>(std::lround(options.cycles * rate / 1000.0)));
  std::deque<SdfCcdMonitor> systems;
  const auto add = [&](const char* system, const CycleRequest& request, const std::shared_ptr<const Scene>& scene) {
    systems.emplace_back(system, request, scene, built.options, waypoints.period);
  };
  add("sdf_ccd", withContacts(false), built.scene);
  if (isWanted(options.systems, "sdf_ccd_verdict")) add("sdf_ccd_verdict", verdictsAlone(), built.scene);
  if (isWanted(options.systems, "sdf_ccd_wrench")) add("sdf_ccd_wrench", withContacts(true), built.scene);
  MonitorSystems peers;
  for (const MonitorPeerFactory& factory : monitorPeers()) factory(built.world.scene, built.scene->pairs, peers);
  const auto isLeftOut = [&](const auto& peer) { return !isWanted(options.systems, peer->name()); };
  peers.erase(std::remove_if(peers.begin(), peers.end(), isLeftOut), peers.end());

  std::vector<CycleTimes> times;
  for (std::size_t k = 0; k < systems.size(); ++k)
    times.emplace_back(waypoints.cycles(), 1);  // the monitor skips pairs by earlier cycles, so it must run all of them
  for (const auto& peer : peers) times.emplace_back(waypoints.cycles(), strideFor(*peer, waypoints));
  const auto take = [&](std::size_t k, std::size_t i) { systems[k].take(waypoints.X_WB[i], waypoints.X_WB[i + 1]); };
  const auto check = [&](std::size_t k, std::size_t i) { peers[k]->check(waypoints.X_WB[i], waypoints.X_WB[i + 1]); };
  for (int run = 0; run < options.measure.runs; ++run) {
    for (std::size_t k = 0; k < systems.size(); ++k) {
      systems[k].reset();
      warmUp([&](std::size_t i) { take(k, i), systems[k].run(); }, waypoints.cycles());
      systems[k].reset();
      times[k].run([&](std::size_t i) { take(k, i); }, [&](std::size_t) { systems[k].run(); });
    }
    for (std::size_t k = 0; k < peers.size(); ++k) {
      warmUp([&](std::size_t i) { check(k, i); }, waypoints.cycles());
      times[systems.size() + k].run([](std::size_t) {}, [&](std::size_t i) { check(k, i); });
    }
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    const std::string system = k < systems.size() ? systems[k].name() : peers[k - systems.size()]->name();
    const auto row = [&](const char* metric, double share) {
      print({"monitor", name, system, metric, 1e6 * times[k].quantile(share), "us", options.measure.runs});
    };
    row("us_median", 0.5);
    row("us_p99", 0.99);
    row("us_p999", 0.999);
  }
  for (SdfCcdMonitor& system : systems) {
    system.reset();
    studyColdCaches(system, waypoints, true, name);
  }
  for (const auto& peer : peers) studyColdCaches(*peer, waypoints, false, name);
  printDepthErrors(systems.front(), waypoints, name);
#ifdef SDF_CCD_WITH_ROS
  if (isWanted(options.systems, "sdf_ccd_tf"))
    studyTransforms(built, waypoints.period, waypoints.cycles(), name, options.measure.runs);
#endif
  if (!isWanted(options.systems, "fcl")) return;
  const Verdicts verdicts = verdictsOf(systems.front(), built.world.scene, waypoints);
  const auto row = [&](const char* metric, double value, const char* unit) {
    print({"monitor", name, "sdf_ccd", metric, value, unit, 1});
  };
  row("bound", 1e3 * verdicts.bound, "mm");
  row("uncertain_share", double(verdicts.uncertain) / double(verdicts.pair_cycles), "of pair-cycles");
  row("contact_share", double(verdicts.contact) / double(verdicts.pair_cycles), "of pair-cycles");
  row("tested", double(verdicts.checked) / double(waypoints.cycles()), "pairs a cycle");
  row("false_clear", double(verdicts.false_clear), "pair-cycles");
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.errors = {"0"};
  full.measure.runs = 5;
  StudyOptions quick = full;
  quick.cycles = 1000;
  return runStudy(argc, argv, "A whole cycle of the monitor beside other libraries", full, quick,
                  [](const StudyOptions& options) {
                    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
                    for (const std::string& argument : robotsOr(options, "demo=" SDF_CCD_DEMO_ARM)) {
                      const Robot robot = loadRobot(argument);
                      for (const auto& [proximity, what] : {std::pair{Proximity::kClear, "clear"},
                                                            {Proximity::kNear, "near"},
                                                            {Proximity::kContact, "contact"},
                                                            {Proximity::kPersistent, "persistent"}}) {
                        if (!isWanted(options.cases, what)) continue;
                        const std::string name = robot.name + "/" + what;
                        const BoxWorld world = makeBoxWorld(robot, proximity, 1e-3 * options.cycles, kSeed);
                        if (proximity == Proximity::kPersistent && world.touching == 0) continue;
                        const Built built = build(robot, world, name, std::stod(options.errors.front()));
                        study(built, 1000.0, name, options);
                        study(built, 50.0, name + "/50Hz", options);
                      }
                    }
                  });
}
