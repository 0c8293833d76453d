// Tunnelling: a hand passes through thin obstacles, checked at several rates and compared with checks at samples.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include <tbb/global_control.h>

#include "common/seconds_since.h"
#include "monitor/monitor_system.h"
#include "monitor/sdf_ccd_monitor.h"
#include "oracle/random.h"
#include "results.h"
#include "robot_case.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kThickness = 1e-3;                                  // of the obstacles [m]
constexpr double kDuration = 0.25;                                   // of a motion [s]
constexpr double kSlowest = 1.0, kFastest = 2.0;                     // [m/s]
constexpr double kTurn = 2.0;                                        // maximum [rad/s]
constexpr double kRates[] = {1000.0, 100.0, 30.0, 1.0 / kDuration};  // [Hz]; the last one has one cycle per motion

/// A thin obstacle at rest, and how a point of the hand passes through it.
struct Obstacle {
  std::string name;
  Box box;
  std::function<Vector3d(test::Random&)> inside, direction;  ///< position of the point [m] and its unit direction
};

std::vector<Obstacle> obstacles() {
  const Vector3d plate(0.3, 0.3, 0.5 * kThickness), tab(0.005, 0.005, 0.5 * kThickness);
  const auto within = [](const Vector3d& half) {
    return [half](test::Random& random) { return test::uniformIn(random, {-0.9 * half, 0.9 * half}); };
  };
  const auto across = [](test::Random& random) -> Vector3d {
    return (Vector3d::UnitZ() + 0.8 * test::direction(random)).normalized();
  };
  const auto on_edge = [plate](test::Random& random) {
    Vector3d p = test::uniformIn(random, {-0.9 * plate, 0.9 * plate});
    p.x() = plate.x() - test::uniform(random, 2e-4, 2e-3);
    return p;
  };
  // Along the edge, up to two degrees off the plate's plane: the hand touches only the edge.
  const auto along = [](test::Random& random) -> Vector3d {
    return Vector3d(test::uniform(random, -0.3, 0.3), 1.0, test::uniform(random, -0.03, 0.03)).normalized();
  };
  return {{"plate", Box::fromSize(2.0 * plate), within(plate), across},
          {"edge", Box::fromSize(2.0 * plate), on_edge, along},
          {"tab", Box::fromSize(2.0 * tab), within(tab), test::direction}};
}

/// The robot's hand as a free body.
BodyDescription handOf(const Robot& robot) {
  for (BodyDescription body : robot.scene.bodies) {
    const std::size_t at = body.name.rfind("hand");
    if (at == std::string::npos || at + 4 != body.name.size() || body.geometry.empty()) continue;
    body.frame = "hand";
    return body;
  }
  throw std::runtime_error(robot.name + ": no link whose name ends in \"hand\" has a collision geometry");
}

/// Centroids of the triangles, in the body's frame.
std::vector<Vector3d> pointsOn(const BodyDescription& body) {
  std::vector<Vector3d> points;
  for (const GeometryDescription& geometry : body.geometry) {
    const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
    for (std::size_t i = 0; mesh && i < (*mesh)->triangles.size(); ++i) {
      Vector3d sum = Vector3d::Zero();
      for (const int vertex : (*mesh)->triangles[i]) sum += (*mesh)->vertices[std::size_t(vertex)];
      points.push_back(geometry.X_BG * Vector3d(sum / 3.0));
    }
  }
  if (points.empty()) throw std::runtime_error(body.name + ": its collision geometry has no mesh");
  return points;
}

/// A motion of the hand with a constant twist in which a point of it is inside the obstacle at `time`, so that there is
/// a contact.
struct Passage {
  Vector3d p_B, p_W, velocity, omega;  ///< [m], [m], [m/s], [rad/s]
  Matrix3d R_WB;                       ///< at `time`
  double time;                         ///< [s]

  Isometry3d at(double t) const {
    const double s = t - time, angle = s * omega.norm();
    Isometry3d X_WB = Isometry3d::Identity();
    const Matrix3d turned = Eigen::AngleAxisd(angle, omega.normalized()).toRotationMatrix();
    X_WB.linear() = turned * R_WB;
    X_WB.translation() = p_W + s * velocity - X_WB.linear() * p_B;
    return X_WB;
  }
};

Passage randomPassage(const Obstacle& obstacle, const std::vector<Vector3d>& points, test::Random& random) {
  Passage passage;
  passage.p_B = points[random() % points.size()];
  passage.p_W = obstacle.inside(random);
  passage.velocity = test::uniform(random, kSlowest, kFastest) * obstacle.direction(random);
  // Rotates about the direction of travel only: the motion is one screw, as the monitor interpolates between samples.
  passage.omega = test::uniform(random, -kTurn, kTurn) * passage.velocity.normalized();
  passage.R_WB = test::pose(random, 3.14, 0.0).linear();
  passage.time = test::uniform(random, 0.4, 0.6) * kDuration;
  return passage;
}

/// Results of a system for all passages.
struct Tally {
  int missed = 0;
  double seconds = 0.0;  // in all cycles
  long cycles = 0;
};

class Study {
 public:
  Study(const Robot& robot, const Obstacle& obstacle, const StudyOptions& options)
      : name_(robot.name + "/" + obstacle.name), obstacle_(obstacle), passages_(options.pairs) {
    BodyDescription hand = handOf(robot);
    points_ = pointsOn(hand);
    BodyDescription thin;
    thin.name = obstacle.name;
    thin.frame = "world";
    thin.is_world = true;
    thin.geometry.push_back({Primitive(obstacle.box), Isometry3d::Identity(), obstacle.name, false});
    description_.bodies = {std::move(hand), std::move(thin)};
  }

  void run() {
    MonitorOptions monitor_options;
    const BodyOptions body_options = preparedAsMonitored(monitor_options);
    const auto scene = std::make_shared<const Scene>(
        buildScene(description_, planScene(description_, planOptions(body_options)), body_options));
    for (const double rate : kRates) {
      SdfCcdMonitor ours("sdf_ccd", verdictsAlone(), scene, monitor_options, 1.0 / rate);
      MonitorSystems peers;
      for (const MonitorPeerFactory& add : monitorPeers()) add(description_, scene->pairs, peers);
      const std::string rated =
          name_ + (rate * kDuration > 1.5 ? "/" + std::to_string(int(rate)) + "Hz" : std::string("/one_step"));
      int uncertain = 0;
      print(rated, ours.name(),
            runAll(
                rate,
                [&](const auto& start, const auto& end, bool is_first) {
                  if (is_first) ours.reset();
                  ours.take(start, end);
                  return ours.run().verdict;
                },
                uncertain));
      benchmark::print({"tunnelling", rated, "sdf_ccd", "uncertain", double(uncertain), "passages"});
      for (const auto& peer : peers) {
        if (peer->name() == "fcl_distance") continue;  // like fcl
        int none = 0;
        print(rated, peer->name(),
              runAll(
                  rate,
                  [&](const auto& start, const auto& end, bool) {
                    return peer->check(start, end) > 0 ? Verdict::kContact : Verdict::kClear;
                  },
                  none));
      }
    }
  }

 private:
  /// @param check  returns a cycle's verdict. @param uncertain  number of passages whose worst verdict is UNCERTAIN.
  template <class Check>
  Tally runAll(double rate, const Check& check, int& uncertain) const {
    Tally tally;
    test::Random random(kSeed);
    const auto cycles = std::lround(rate * kDuration);
    for (int i = 0; i < passages_; ++i) {
      const Passage passage = randomPassage(obstacle_, points_, random);
      Verdict worst = Verdict::kClear;
      std::vector<Isometry3d> start{passage.at(0.0), Isometry3d::Identity()}, end = start;
      for (long k = 0; k < cycles; ++k) {
        end[0] = passage.at(kDuration * double(k + 1) / double(cycles));
        const auto begin = std::chrono::steady_clock::now();
        worst = worseOf(worst, check(start, end, k == 0));
        tally.seconds += secondsSince(begin);
        start = end;
      }
      tally.cycles += cycles;
      tally.missed += worst != Verdict::kUncertain && worst != Verdict::kContact;
      uncertain += worst == Verdict::kUncertain;
    }
    return tally;
  }

  void print(const std::string& rated, const std::string& system, const Tally& tally) const {
    benchmark::print({"tunnelling", rated, system, "passages", double(passages_), "passages"});
    benchmark::print({"tunnelling", rated, system, "missed", double(tally.missed), "passages"});
    benchmark::print({"tunnelling", rated, system, "us_cycle", 1e6 * tally.seconds / double(tally.cycles), "us"});
  }

  std::string name_;
  const Obstacle& obstacle_;
  int passages_;
  std::vector<Vector3d> points_;
  SceneDescription description_;
};

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.pairs = 1000;
  StudyOptions quick;
  quick.pairs = 100;
  return runStudy(argc, argv, "A hand that passes through what is thin: who sees it", full, quick,
                  [](const StudyOptions& options) {
                    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
                    for (const std::string& argument : robotsOr(options, "demo=" SDF_CCD_DEMO_ARM)) {
                      const Robot robot = loadRobot(argument);
                      for (const Obstacle& obstacle : obstacles())
                        if (isWanted(options.cases, obstacle.name)) Study(robot, obstacle, options).run();
                    }
                  });
}
