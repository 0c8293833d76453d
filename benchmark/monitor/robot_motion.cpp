#include "monitor/robot_motion.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "oracle/shapes.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr double kAngle = 0.5, kSlide = 0.05;      // maximum amplitudes [rad], [m]
constexpr double kShare = 0.4;                     // maximum amplitude, as a share of a joint's range
constexpr double kSlowest = 0.1, kFastest = 0.35;  // [Hz]

}  // namespace

RobotMotion::RobotMotion(const Robot& robot, std::uint64_t seed) : model_(&robot.model) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (const auto& [name, joint] : robot.model.urdf().joints_) {
    if (!isDriven(*joint)) continue;
    const JointRange range = rangeOf(*joint);
    const double most = joint->type == urdf::Joint::PRISMATIC ? kSlide : kAngle;
    const double amplitude = std::min(most, kShare * (range.high - range.low));
    const double middle = uniform(range.low + amplitude, range.high - amplitude);
    waves_.push_back(
        {name, middle, amplitude, 2.0 * test::kPi * uniform(kSlowest, kFastest), uniform(0.0, 2.0 * test::kPi)});
  }
}

JointPositions RobotMotion::positionsAt(double time) const {
  JointPositions positions;
  for (const Wave& wave : waves_) {
    positions[wave.joint] = wave.middle + wave.amplitude * std::sin(wave.rate * time + wave.phase);
  }
  return positions;
}

std::vector<Isometry3d> RobotMotion::posesAt(double time, const std::vector<BodyDescription>& bodies) const {
  return benchmark::posesAt(*model_, positionsAt(time), bodies);
}

std::vector<Isometry3d> posesAt(const RobotModel& model, const JointPositions& positions,
                                const std::vector<BodyDescription>& bodies) {
  const std::vector<Isometry3d> X_RL = model.forwardKinematics(positions);
  const std::vector<std::string>& links = model.links();
  std::vector<Isometry3d> X_RB;
  for (const BodyDescription& body : bodies) {
    const std::size_t link = std::find(links.begin(), links.end(), body.frame) - links.begin();
    X_RB.push_back(X_RL.at(link) * body.X_frame_B);
  }
  return X_RB;
}

}  // namespace sdf_ccd::benchmark
