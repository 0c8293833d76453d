#include "monitor/box_world.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "monitor/fcl_scene.h"
#include "oracle/random.h"
#include "sdf_ccd/robot.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr int kBoxes = 20;
constexpr int kMotions = 20;          // candidates to choose from
constexpr double kTimeStep = 0.02;    // between the robot's sampled poses [s]
constexpr double kCoarseStep = 0.25;  // the same while choosing a motion [s]

using Poses = std::vector<std::vector<Isometry3d>>;  // per time, per body

Poses posesOf(const RobotMotion& motion, const std::vector<BodyDescription>& bodies, double seconds, double step) {
  Poses poses;
  for (double time = 0.0; time < seconds; time += step) poses.push_back(motion.posesAt(time, bodies));
  return poses;
}

/// The planned pairs that touch in at least one of the poses.
std::vector<PlannedPair> touching(FclScene& fcl, std::vector<PlannedPair> pairs, const Poses& poses) {
  std::vector<PlannedPair> found;
  for (const std::vector<Isometry3d>& X_WB : poses) {
    for (std::size_t body = 0; body < X_WB.size(); ++body) fcl.move(static_cast<int>(body), X_WB[body]);
    const auto touches = [&](const PlannedPair& pair) { return fcl.collide(pair.body_a, pair.body_b); };
    const auto first =
        std::stable_partition(pairs.begin(), pairs.end(), [&](const auto& pair) { return !touches(pair); });
    found.insert(found.end(), first, pairs.end());
    pairs.erase(first, pairs.end());
  }
  return found;
}

RobotMotion calmestMotion(const Robot& robot, FclScene& fcl, double seconds, std::uint64_t seed) {
  const std::vector<PlannedPair> pairs = planScene(robot.scene).pairs;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  std::uint64_t best = seed;
  for (std::uint64_t tried = 0; tried < kMotions && fewest > 0; ++tried) {
    const RobotMotion motion(robot, seed + tried);
    const std::size_t count = touching(fcl, pairs, posesOf(motion, robot.scene.bodies, seconds, kCoarseStep)).size();
    if (count < fewest) {
      fewest = count;
      best = seed + tried;
    }
  }
  return RobotMotion(robot, best);
}

/// Places boxes at given distances from a moving robot.
class Placer {
 public:
  Placer(const Robot& robot, const Poses& poses, FclScene& fcl) : robot_(robot), poses_(poses), fcl_(fcl) {
    for (std::size_t body = 0; body < robot.scene.bodies.size(); ++body) {
      const bool stands = robot.model.rigidlyJoined(robot.model.root(), robot.scene.bodies[body].frame);
      if (!stands && !robot.scene.bodies[body].geometry.empty()) moved_.push_back(static_cast<int>(body));
    }
    if (moved_.empty()) throw std::runtime_error(robot.name + ": nothing that moves has a collision geometry");
  }

  /// A box whose minimum distance from the robot's moving bodies is `wanted` [m]; if that is negative, the box is moved
  /// that much farther into them.
  BodyDescription place(int number, double wanted, test::Random& random) {
    BodyDescription box = randomBox(robot_, number, random);
    const int index = fcl_.add(box);

    constexpr int kAttempts = 100;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::vector<Isometry3d>& seen = poses_[random() % poses_.size()];
      const int aim = moved_[random() % moved_.size()];
      fcl_.move(aim, seen[std::size_t(aim)]);
      const Vector3d from = test::direction(random);
      Isometry3d X_WB = test::pose(random, 3.0, 0.0);
      X_WB.translation() = fcl_.ball(aim).center_W + kFar * from;
      if (!approach(index, std::max(wanted, 1e-4), from, X_WB)) continue;
      if (wanted < 0.0) X_WB.translation() += wanted * from;
      box.X_frame_B = X_WB;
      return box;
    }
    throw std::runtime_error(robot_.name + ": no pose found at which " + box.name + " is " + std::to_string(wanted) +
                             " m from the robot, in " + std::to_string(kAttempts) + " attempts");
  }

 private:
  static constexpr double kFar = 2.0;  // from where a box approaches [m]

  /// Moves a box against `from` until its minimum distance is `gap`, by conservative advancement.
  /// @return false if it passes the robot.
  bool approach(int box, double gap, const Vector3d& from, Isometry3d& X_WB) {
    double moved = 0.0;
    for (double free = 1.0; free > 1e-4 && moved < 2.0 * kFar; moved += std::max(free, 0.0)) {
      free = robotDistance(box, X_WB) - gap;
      X_WB.translation() -= std::max(free, 0.0) * from;
    }
    return moved < 2.0 * kFar;
  }

  /// Minimum distance [m] over all poses between the robot's moving bodies and a box at X_WB; at most 1 m.
  double robotDistance(int box, const Isometry3d& X_WB) {
    fcl_.move(box, X_WB);
    const FclScene::Ball own = fcl_.ball(box);
    double least = 1.0;
    for (const std::vector<Isometry3d>& poses : poses_) {
      for (const int body : moved_) {
        fcl_.move(body, poses[std::size_t(body)]);
        const FclScene::Ball ball = fcl_.ball(body);
        if ((ball.center_W - own.center_W).norm() - ball.radius - own.radius >= least) continue;
        least = fcl_.distance(body, box, least);
      }
    }
    return least;
  }

  const Robot& robot_;
  const Poses& poses_;
  FclScene& fcl_;
  std::vector<int> moved_;  // bodies that are not rigidly joined to the root
};

double wantedDistance(Proximity proximity, int box, test::Random& random) {
  if (proximity == Proximity::kNear && box % 2 == 0) return test::uniform(random, 0.001, 0.01);
  if (proximity == Proximity::kContact && box % 5 == 0) return test::uniform(random, -0.02, -0.002);
  return test::uniform(random, 0.03, 0.2);
}

/// @param touching  pairs of the robot's bodies that touch in the poses.
SceneDescription boxesAbout(const Robot& robot, const Poses& poses, FclScene& fcl,
                            const std::vector<PlannedPair>& touching, Proximity proximity, std::uint64_t seed) {
  SceneDescription scene = robot.scene;
  for (const PlannedPair& pair : touching) {
    const auto name = [&](int body) { return robot.scene.bodies[std::size_t(body)].name; };
    if (proximity != Proximity::kPersistent)
      scene.allowed.push_back({name(pair.body_a), name(pair.body_b), "touch along the motion"});
  }
  Placer placer(robot, poses, fcl);
  test::Random random(seed);
  for (int box = 0; box < kBoxes; ++box) {
    scene.bodies.push_back(placer.place(box, wantedDistance(proximity, box, random), random));
  }
  setRigidRoots(robot.model, scene);
  return scene;
}

}  // namespace

BoxWorld makeBoxWorld(const Robot& robot, Proximity proximity, double seconds, std::uint64_t seed) {
  FclScene fcl(robot.scene.bodies);
  const RobotMotion motion = calmestMotion(robot, fcl, seconds, seed);
  const Poses poses = posesOf(motion, robot.scene.bodies, seconds, kTimeStep);
  const std::vector<PlannedPair> touch = touching(fcl, planScene(robot.scene).pairs, poses);
  return {boxesAbout(robot, poses, fcl, touch, proximity, seed), motion, touch.size()};
}

SceneDescription boxesAbout(const Robot& robot, const Poses& poses, Proximity proximity, std::uint64_t seed) {
  FclScene fcl(robot.scene.bodies);
  return boxesAbout(robot, poses, fcl, touching(fcl, planScene(robot.scene).pairs, poses), proximity, seed);
}

}  // namespace sdf_ccd::benchmark
