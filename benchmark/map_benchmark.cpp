// A robot in an OctoMap: verdicts, their error bound and the time of a cycle, beside FCL's discrete check of the same
// links against the same tree.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <random>

#include <fcl/geometry/octree/octree.h>
#include <octomap/OcTree.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include "common/seconds_since.h"
#include "monitor/cycle_times.h"
#include "monitor/fcl_scene.h"
#include "monitor/robot_motion.h"
#include "monitor/sdf_ccd_monitor.h"
#include "motion/screw_motion.h"
#include "results.h"
#include "sdf_ccd/mesh.h"
#include "shell/point_shell.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kRate = 100.0;  // cycles per second of motion
constexpr std::size_t kCyclesPerPlace = 200;
constexpr int kTruthPoses = 10;  // at which FCL checks a CLEAR within a cycle

/// A room of 6 × 6 × 2.4 m with shelves and boxes, in voxels of 5 cm.
std::shared_ptr<octomap::OcTree> room() {
  auto tree = std::make_shared<octomap::OcTree>(0.05);
  const auto fill = [&](std::array<double, 3> low, std::array<double, 3> high) {
    for (double x = low[0] + 0.025; x < high[0]; x += 0.05)
      for (double y = low[1] + 0.025; y < high[1]; y += 0.05)
        for (double z = low[2] + 0.025; z < high[2]; z += 0.05)
          tree->updateNode(octomap::point3d(float(x), float(y), float(z)), true, true);
  };
  fill({-3, -3, -0.1}, {3, 3, 0});
  for (const double wall : {-3.0, 2.9}) {
    fill({wall, -3, 0}, {wall + 0.1, 3, 2.4});
    fill({-3, wall, 0}, {3, wall + 0.1, 2.4});
  }
  for (int i = 0; i < 12; ++i) {
    const double x = -2.5 + 1.3 * (i % 4), y = -2.0 + 1.6 * (i / 4);
    fill({x, y, 0}, {x + 0.4, y + 0.3, 0.3 + 0.1 * (i % 5)});
    fill({x, y, 1.2}, {x + 0.4, y + 0.3, 1.25});
  }
  tree->updateInnerOccupancy();
  return tree;
}

/// The tree of a map, and its file.
struct Map {
  std::string name;
  std::string file;
  std::shared_ptr<octomap::OcTree> tree;
};

Map loadMap(const std::string& file) {
  if (!file.empty()) return {std::filesystem::path(file).stem(), file, std::make_shared<octomap::OcTree>(file)};
  Map map{"room", std::filesystem::temp_directory_path() / ("room_" + std::to_string(::getpid()) + ".bt"), room()};
  map.tree->writeBinary(map.file);
  return map;
}

/// A robot's links and a map, of which only the pairs of a link and the map are checked.
SceneDescription sceneOf(const Robot& robot, const Map& map) {
  SceneDescription scene = robot.scene;
  for (std::size_t a = 0; a < scene.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < scene.bodies.size(); ++b)
      scene.allowed.push_back({scene.bodies[a].name, scene.bodies[b].name, "of the robot"});
  double size = 0.0;
  BodyDescription body;
  body.name = body.frame = "octomap";
  body.is_world = true;
  body.geometry.emplace_back();
  body.geometry[0].shape = std::make_shared<const TriangleMesh>(loadOctomapSurface(map.file, size));
  body.geometry[0].source = map.file;
  body.geometry[0].watertight_voxels = true;
  body.geometry[0].cell_size = 0.5 * size;
  scene.bodies.push_back(body);
  return scene;
}

/// The links in FCL, against the tree.
class FclLinks {
 public:
  FclLinks(const std::vector<BodyDescription>& links, const std::shared_ptr<const octomap::OcTree>& tree)
      : scene_(links), tree_(scene_.add(std::make_shared<fcl::OcTreed>(tree))) {}

  bool touches(std::size_t link, const Isometry3d& X_WB) {
    scene_.move(static_cast<int>(link), X_WB);
    return scene_.collide(static_cast<int>(link), tree_);
  }

 private:
  FclScene scene_;
  int tree_;
};

/// Poses of all bodies along motions that begin near something occupied without touching it, one motion per place.
std::vector<std::vector<std::vector<Isometry3d>>> motionsIn(const Map& map, const Robot& robot, std::size_t places,
                                                            FclLinks& links) {
  std::vector<octomap::point3d> occupied;
  for (auto leaf = map.tree->begin_leafs(); leaf != map.tree->end_leafs(); ++leaf)
    if (map.tree->isNodeOccupied(*leaf)) occupied.push_back(leaf.getCoordinate());
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<std::vector<std::vector<Isometry3d>>> motions;
  for (int trial = 0; motions.size() < places && trial < 10'000; ++trial) {
    const octomap::point3d& near = occupied[random() % occupied.size()];
    Isometry3d X_WR = Isometry3d::Identity();
    X_WR.translation() = Vector3d(near.x() + uniform(-0.8, 0.8), near.y() + uniform(-0.8, 0.8), uniform(0.05, 0.3));
    const RobotMotion motion(robot, random());
    std::vector<std::vector<Isometry3d>> poses;
    for (std::size_t k = 0; k <= kCyclesPerPlace; ++k) {
      poses.push_back(motion.posesAt(double(k) / kRate, robot.scene.bodies));
      for (Isometry3d& X : poses.back()) X = X_WR * X;
      poses.back().push_back(Isometry3d::Identity());  // the map
      bool touches = false;
      for (std::size_t b = 0; k == 0 && b + 1 < poses[0].size(); ++b) touches |= links.touches(b, poses[0][b]);
      if (touches) break;
    }
    if (poses.size() > kCyclesPerPlace) motions.push_back(std::move(poses));
  }
  return motions;
}

void study(const Robot& robot, const Map& map, const StudyOptions& options) {
  const std::string name = robot.name + "/" + map.name;
  const auto row = [&](const char* system, const char* metric, double value, const char* unit) {
    print({"map", name, system, metric, value, unit, options.measure.runs});
  };
  const SceneDescription description = sceneOf(robot, map);
  const MonitorOptions monitor;
  const BodyOptions prepared = preparedAsMonitored(monitor);
  const auto start = Clock::now();
  const auto scene =
      std::make_shared<const Scene>(buildScene(description, planScene(description, planOptions(prepared)), prepared));
  row("sdf_ccd", "start_up", secondsSince(start), "s");
  const BodyReport& report = scene->reports.back();
  row("sdf_ccd", "memory", 1e-6 * double(report.field_bytes + report.shell_bytes), "MB");

  FclLinks links(robot.scene.bodies, map.tree);
  const auto motions = motionsIn(map, robot, std::max(1, options.pairs / 25), links);
  const std::size_t cycles = motions.size() * kCyclesPerPlace, bodies = robot.scene.bodies.size();
  const auto at = [&](std::size_t i) { return &motions[i / kCyclesPerPlace][i % kCyclesPerPlace]; };
  SdfCcdMonitor verdicts("sdf_ccd", verdictsAlone(), scene, monitor, 1.0 / kRate);
  CycleRequest with_contacts;
  with_contacts.skipped_pairs = false;
  SdfCcdMonitor contacts("sdf_ccd_wrench", with_contacts, scene, monitor, 1.0 / kRate);
  CycleTimes of_verdicts(cycles, 1), of_contacts(cycles, 1), of_fcl(cycles, 1);
  const auto runOurs = [&](SdfCcdMonitor& system, CycleTimes& times) {
    times.run(
        [&](std::size_t i) {
          if (i % kCyclesPerPlace == 0) system.reset();
          system.take(*at(i), *(at(i) + 1));
        },
        [&](std::size_t) { system.run(); });
  };
  for (int run = 0; run < options.measure.runs; ++run) {
    runOurs(verdicts, of_verdicts);
    runOurs(contacts, of_contacts);
    of_fcl.run([](std::size_t) {},
               [&](std::size_t i) {
                 for (std::size_t b = 0; b < bodies; ++b) links.touches(b, (*(at(i) + 1))[b]);
               });
  }
  for (const auto& [times, system] :
       {std::pair{&of_verdicts, "sdf_ccd"}, {&of_contacts, "sdf_ccd_wrench"}, {&of_fcl, "fcl"}}) {
    row(system, "us_median", 1e6 * times->quantile(0.5), "us");
    row(system, "us_p99", 1e6 * times->quantile(0.99), "us");
  }

  double bound = 0.0;
  long uncertain = 0, contact = 0, false_clear = 0, seen = 0;
  for (std::size_t i = 0; i < cycles; ++i) {
    if (i % kCyclesPerPlace == 0) verdicts.reset();
    verdicts.take(*at(i), *(at(i) + 1));
    const CycleResult& result = verdicts.run();
    bound = std::max(bound, result.error_bound);
    for (const PairResult& pair : result.pairs) {
      uncertain += pair.verdict == Verdict::kUncertain;
      contact += pair.verdict == Verdict::kContact;
      const auto link = static_cast<std::size_t>(pair.body_a);
      const ScrewMotion screw((*at(i))[link], (*(at(i) + 1))[link]);
      bool touches = false;
      for (int pose = 1; !touches && pose <= kTruthPoses; ++pose)
        touches = links.touches(link, screw.pose(double(pose) / kTruthPoses));
      seen += touches;
      false_clear += touches && pair.verdict == Verdict::kClear;
    }
  }
  const double pairs = double(cycles) * double(scene->pairs.size());
  row("sdf_ccd", "bound", 1e3 * bound, "mm");
  row("sdf_ccd", "uncertain_share", double(uncertain) / pairs, "of pair-cycles");
  row("sdf_ccd", "contact_share", double(contact) / pairs, "of pair-cycles");
  row("fcl", "contact_share", double(seen) / pairs, "of pair-cycles");
  row("sdf_ccd", "false_clear", double(false_clear), "pair-cycles");
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.measure.runs = 5;
  StudyOptions quick = full;
  quick.pairs = 100;
  return runStudy(argc, argv, "A robot's cycles in an OctoMap beside FCL", full, quick,
                  [](const StudyOptions& options) {
                    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
                    const Map map = loadMap(options.map);
                    for (const std::string& robot : robotsOr(options, "demo=" SDF_CCD_DEMO_ARM))
                      study(loadRobot(robot), map, options);
                    if (options.map.empty()) std::filesystem::remove(map.file);
                  });
}
