// Edges of a planner's graph: certified along the whole motion, compared with other libraries that test a number of
// poses.
#include <algorithm>
#include <chrono>
#include <cmath>

#include <tbb/global_control.h>

#include "common/seconds_since.h"
#include "monitor/box_world.h"
#include "monitor/fcl_scene.h"
#include "monitor/monitor_system.h"
#include "motion/motion_sampling.h"
#include "precision/error_summary.h"
#include "results.h"
#include "robot/planned_motion.h"
#include "robot_monitor/check_motion.h"
#include "sdf_ccd/body.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLength = 0.5;           // of an edge, in joint space [rad]
constexpr double kMaxMissShare = 1e-4;    // of the edges; a system that misses fewer is not refined further
constexpr int kFinest = 512;              // poses per edge, for the reference
constexpr double kSecondsPerRun = 100.0;  // a system is not refined further after a run that took longer
constexpr std::uint64_t kSeed = 1;

struct Edge {
  JointPositions start, end;
};

JointPositions between(const Edge& edge, double share) {
  JointPositions positions;
  for (const auto& [joint, start] : edge.start) positions[joint] = start + share * (edge.end.at(joint) - start);
  return positions;
}

/// Edges of equal length in random directions, whose ends are free of contact.
std::vector<Edge> randomEdges(const Robot& robot, const SceneDescription& scene, const std::vector<PlannedPair>& pairs,
                              std::size_t count) {
  FclScene fcl(scene.bodies);
  const auto isFree = [&](const JointPositions& positions) {
    const std::vector<Isometry3d> X_RB = posesAt(robot.model, positions, scene.bodies);
    for (std::size_t body = 0; body < X_RB.size(); ++body) fcl.move(static_cast<int>(body), X_RB[body]);
    return std::none_of(pairs.begin(), pairs.end(),
                        [&](const PlannedPair& pair) { return fcl.collide(pair.body_a, pair.body_b); });
  };
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  std::vector<Edge> edges;
  while (edges.size() < count) {
    Edge edge{randomPositions(robot.model, random), {}};
    double squares = 0.0;
    JointPositions way;
    for (const auto& [joint, start] : edge.start) {
      way[joint] = normal(random);
      squares += way[joint] * way[joint];
    }
    bool is_within = true;
    for (const auto& [joint, start] : edge.start) {
      edge.end[joint] = start + kLength / std::sqrt(squares) * way[joint];
      const JointRange range = rangeOf(*robot.model.urdf().getJoint(joint));
      is_within = is_within && edge.end[joint] >= range.low && edge.end[joint] <= range.high;
    }
    if (is_within && isFree(edge.start) && isFree(edge.end)) edges.push_back(edge);
  }
  return edges;
}

/// Poses at the ends of equal parts of an edge; per pose, per body.
using Poses = std::vector<std::vector<Isometry3d>>;

Poses posesAlong(const Robot& robot, const SceneDescription& scene, const Edge& edge, int parts) {
  Poses poses;
  for (int k = 0; k <= parts; ++k)
    poses.push_back(posesAt(robot.model, between(edge, double(k) / parts), scene.bodies));
  return poses;
}

/// Whether a system finds a contact in any of the parts.
bool touches(MonitorSystem& system, const Poses& poses) {
  for (std::size_t k = 0; k + 1 < poses.size(); ++k)
    if (system.check(poses[k], poses[k + 1]) > 0) return true;
  return false;
}

class Study {
 public:
  Study(const Robot& robot, const StudyOptions& options)
      : robot_(robot),
        options_(options),
        name_(robot.name + "/edges"),
        world_(makeBoxWorld(robot, Proximity::kClear, 5.0, kSeed)) {
    BodyOptions body = optionsFor({0.01});
    monitor_.chords.tolerance = 1e-4;
    scene_ = std::make_shared<const Scene>(buildScene(world_.scene, planScene(world_.scene, planOptions(body)), body));
    edges_ = randomEdges(robot_, world_.scene, scene_->pairs, static_cast<std::size_t>(options.cycles));
    bodies_ = bodiesOf(*scene_, robot_.model);
  }

  void run() {
    row("sdf_ccd", "pairs", double(scene_->pairs.size()), "pairs");
    row("sdf_ccd", "edges", double(edges_.size()), "edges");
    measureOurs();
    findTruth();
    printOurs();
    for (const MonitorPeerFactory& factory : monitorPeers()) {
      MonitorSystems systems;
      factory(world_.scene, scene_->pairs, systems);
      for (const auto& system : systems)
        if (system->name() != "fcl_distance") measurePeer(*system);
    }
  }

 private:
  void row(const std::string& system, const char* metric, double value, const char* unit, int runs = 1) const {
    print({"planning", name_, system, metric, value, unit, runs});
  }

  std::vector<MotionVerdict> check() const {
    return checkMotions(scene_, monitor_, edges_.size(), [&](std::size_t i, double tolerance) {
      RobotTrajectory trajectory;
      trajectory.times = {0.0, 1.0};
      trajectory.states.resize(2);
      trajectory.states[0].positions = edges_[i].start;
      trajectory.states[1].positions = edges_[i].end;
      MotionSampling sampling;
      sampling.tolerance = tolerance;
      return planAlong(robot_.model, completePlan(robot_.model, trajectory, {}, {}), bodies_, sampling);
    });
  }

  void measureOurs() {
    std::vector<double> single, threaded;
    for (int run = 0; run < options_.measure.runs; ++run) {
      const auto start = Clock::now();
      verdicts_ = check();
      threaded.push_back(secondsSince(start));
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      const auto start_single = Clock::now();
      check();
      single.push_back(secondsSince(start_single));
    }
    row("sdf_ccd", "us_edge", 1e6 * precision::quantile(single, 0.5) / double(edges_.size()), "us",
        options_.measure.runs);
    row("sdf_ccd_threads", "us_edge", 1e6 * precision::quantile(threaded, 0.5) / double(edges_.size()), "us",
        options_.measure.runs);
  }

  /// Computes the reference: an edge has contact if that is certified, or if FCL finds it at one of kFinest poses.
  void findTruth() {
    FclScene fcl(world_.scene.bodies);
    truth_.assign(edges_.size(), false);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      truth_[i] = verdicts_[i].verdict == Verdict::kContact;
      for (int k = 1; k <= kFinest && !truth_[i]; ++k) {
        const auto X_RB = posesAt(robot_.model, between(edges_[i], double(k) / kFinest), world_.scene.bodies);
        for (std::size_t body = 0; body < X_RB.size(); ++body) fcl.move(static_cast<int>(body), X_RB[body]);
        for (const PlannedPair& pair : scene_->pairs)
          if (fcl.collide(pair.body_a, pair.body_b)) truth_[i] = true;
      }
    }
    row("truth", "touching", double(std::count(truth_.begin(), truth_.end(), true)), "edges");
  }

  void printOurs() const {
    double bound = 0.0;
    long uncertain = 0, misses = 0;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      bound = std::max(bound, verdicts_[i].error_bound);
      uncertain += verdicts_[i].verdict == Verdict::kUncertain;
      misses += truth_[i] && verdicts_[i].verdict == Verdict::kClear;
    }
    row("sdf_ccd", "misses", double(misses), "edges");
    row("sdf_ccd", "uncertain", double(uncertain), "edges");
    row("sdf_ccd", "bound", 1e3 * bound, "mm");
  }

  /// Doubles the number of parts until the system misses almost no edge.
  void measurePeer(MonitorSystem& system) const {
    for (int parts = 1; parts <= kFinest; parts *= 2) {
      double seconds = 0.0;
      long misses = 0, false_contacts = 0;
      for (std::size_t i = 0; i < edges_.size(); ++i) {
        const Poses poses = posesAlong(robot_, world_.scene, edges_[i], parts);  // not timed
        const auto start = Clock::now();
        const bool found = touches(system, poses);
        seconds += secondsSince(start);
        misses += truth_[i] && !found;
        false_contacts += found && !truth_[i];
      }
      const std::string name = system.name() + "_" + std::to_string(parts);
      row(name, "us_edge", 1e6 * seconds / double(edges_.size()), "us");
      row(name, "misses", double(misses), "edges");
      row(name, "false_contacts", double(false_contacts), "edges");
      if (double(misses) < kMaxMissShare * double(edges_.size()) || seconds > kSecondsPerRun) return;
    }
  }

  const Robot& robot_;
  const StudyOptions& options_;
  std::string name_;
  BoxWorld world_;
  MonitorOptions monitor_;
  std::shared_ptr<const Scene> scene_;
  std::vector<Edge> edges_;
  PlannedBodies bodies_;
  std::vector<MotionVerdict> verdicts_;
  std::vector<bool> truth_;
};

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.measure.runs = 5;
  StudyOptions quick = full;
  quick.cycles = 500;
  quick.measure.runs = 3;
  return runStudy(argc, argv, "Edges of a planner's graph, certified, beside other libraries", full, quick,
                  [](const StudyOptions& options) {
                    for (const std::string& argument : robotsOr(options, "demo=" SDF_CCD_DEMO_ARM)) {
                      const Robot robot = loadRobot(argument);
                      Study(robot, options).run();
                    }
                  });
}
