#include "robot/trajectory_motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "common/infinity.h"
#include "common/number_text.h"
#include "common/refuse.h"
#include "joint_kind.h"
#include "joint_motion.h"
#include "motion/chain_derivatives.h"
#include "robot/planned_motion.h"
#include "urdf_geometry.h"

namespace sdf_ccd {
namespace {

constexpr double kAngle = 1.0;                    // maximum rotation of a link between two waypoints [rad]
constexpr std::size_t kMaxAddedWaypoints = 2000;  // about 300 revolutions

double angleBetween(const Isometry3d& X_a, const Isometry3d& X_b) {
  return Quaterniond(X_a.linear()).angularDistance(Quaterniond(X_b.linear()));
}

Isometry3d between(const Isometry3d& X_start, const Isometry3d& X_end, double s) {
  if (s == 0.0 || X_start.matrix() == X_end.matrix()) return X_start;
  if (s == 1.0) return X_end;
  Isometry3d X(Quaterniond(X_start.linear()).slerp(s, Quaterniond(X_end.linear())).normalized());
  X.translation() = (1.0 - s) * X_start.translation() + s * X_end.translation();
  return X;
}

template <class Map>
bool sameKeys(const Map& a, const Map& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) { return x.first == y.first; });
}

/// Requires that the poses of the root, or of a joint, in all states define the direction of each rotation.
template <class PoseOf>
void requirePoses(const std::vector<RobotState>& states, const PoseOf& pose_of, const std::string& what) {
  std::vector<Isometry3d> poses;
  for (const RobotState& state : states) poses.push_back(pose_of(state));
  for (const Isometry3d& pose : poses) {
    if (!pose.matrix().allFinite()) refuse(what + ": a pose is not finite");
    if (!(pose.translation().lpNorm<Eigen::Infinity>() <= kFarthestPose))
      refuse(what + ": a pose is more than " + numberText(kFarthestPose) + " m from the origin");
  }
  requireUnambiguousTurns(poses, what);
}

/// The end of the segment that contains the time, by its waypoint.
std::size_t segmentAt(const std::vector<double>& times, double time) {
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  return std::clamp<std::size_t>(next - times.begin(), 1, times.size() - 1);
}

/// The points of a body, transformed from frame to frame along its chain.
class CarriedPoints {
 public:
  explicit CarriedPoints(const CarriedBody& body) : ball_(body.ball_B), X_(body.X_LB) {}

  void carry(const Isometry3d& X) { X_ = X * X_; }

  /// x ↦ t(s) + R(s) x, t from X_start's to t_end.
  void move(const Isometry3d& X_start, const Vector3d& t_end, double angle, double share) {
    const DerivativeBounds slide = {share * (t_end - X_start.translation()).norm()};
    if (angle == 0.0) {
      carry(Isometry3d(X_start.linear()));
      begin();
      const Vector3d& p = X_.translation();
      chain_->addFrame(std::max((p + X_start.translation()).norm(), (p + t_end).norm()), {}, slide);
    } else {
      begin();
      chain_->addFrame(X_.translation().norm(), {}, {});
      chain_->addFrame(std::max(X_start.translation().norm(), t_end.norm()), {share * angle}, slide);
    }
    X_.setIdentity();
  }

  double jerk() const { return chain_ ? chain_->jerk() : 0.0; }

 private:
  /// Rigid transforms so far have moved the ball of the points exactly.
  void begin() {
    if (chain_) return;
    chain_.emplace(BoundingBall{X_ * ball_.center, ball_.radius});
    X_.setIdentity();
  }

  BoundingBall ball_;
  Isometry3d X_;  // from the points, or the last moving frame, to the current frame
  std::optional<ChainDerivatives> chain_;
};

}  // namespace

RobotState stateAt(const RobotTrajectory& trajectory, double time) {
  const std::vector<double>& times = trajectory.times;
  const std::size_t end = segmentAt(times, time);
  const double s = (time - times[end - 1]) / (times[end] - times[end - 1]);
  const RobotState &from = trajectory.states[end - 1], &to = trajectory.states[end];
  if (s == 1.0) return to;
  RobotState state = from;
  state.X_WR = between(from.X_WR, to.X_WR, s);
  for (auto& [joint, position] : state.positions) position += s * (to.positions.at(joint) - position);
  for (auto& [joint, pose] : state.poses) pose = between(pose, to.poses.at(joint), s);
  return state;
}

RobotTrajectory merged(const RobotTrajectory& joints, const RobotTrajectory& joints_and_root) {
  const std::vector<double>&a = joints.times, &b = joints_and_root.times;
  if (a.front() != b.front() || a.back() != b.back()) refuse("two trajectories do not begin and end at the same times");
  RobotTrajectory both;
  both.joint_error = std::max(joints.joint_error, joints_and_root.joint_error);
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both.times));
  for (const double time : both.times) {
    RobotState state = stateAt(joints_and_root, time);
    const RobotState other = stateAt(joints, time);
    state.positions.insert(other.positions.begin(), other.positions.end());
    state.poses.insert(other.poses.begin(), other.poses.end());
    both.states.push_back(state);
  }
  return both;
}

TrajectoryMotion::TrajectoryMotion(const RobotModel& robot, const RobotTrajectory& trajectory,
                                   const std::vector<CarriedBody>& bodies)
    : robot_(robot), trajectory_(trajectory), bodies_(bodies) {
  const std::vector<RobotState>& states = trajectory_.states;
  if (states.size() < 2 || states.size() != trajectory_.times.size())
    refuse("a trajectory needs two waypoints or more");
  for (std::size_t i = 0; i < states.size(); ++i) {
    robot_.forwardKinematics(states[i].positions, states[i].poses);  // rejects invalid states
    if (i == 0) continue;
    if (!(trajectory_.times[i] > trajectory_.times[i - 1])) {
      refuse("the time of waypoint " + std::to_string(i) + " does not increase");
    }
    if (!sameKeys(states[i].positions, states[0].positions) || !sameKeys(states[i].poses, states[0].poses)) {
      refuse("waypoint " + std::to_string(i) + " does not name the joints of the first one");
    }
  }
  requirePoses(
      states, [](const RobotState& state) { return state.X_WR; }, "the robot's root");
  for (const auto& joint : states[0].poses) {
    requirePoses(
        states, [&](const RobotState& state) { return state.poses.at(joint.first); }, "joint " + joint.first);
  }
}

std::vector<double> TrajectoryMotion::waypoints() const {
  const std::vector<double>& times = trajectory_.times;
  std::vector<double> waypoints = {times.front()};
  std::size_t added = 0;
  double turned = 0.0;
  std::vector<FrameMove> moves;
  for (std::size_t i = 1; i < times.size(); ++i) {
    moveAlong(i, moves);
    double angle = 0.0;  // maximum over links: the sum over its chain
    std::vector<double> angles(moves.size());
    for (std::size_t link = 0; link < moves.size(); ++link) {
      angles[link] = moves[link].angle + (link > 0 ? angles[robot_.parent(static_cast<int>(link))] : 0.0);
      angle = std::max(angle, angles[link]);
    }
    turned += angle;
    const double pieces = std::max(1.0, std::ceil(angle / kAngle));
    if (!(pieces - 1.0 <= static_cast<double>(kMaxAddedWaypoints - added))) {
      refuse(fmt::format(
          "the trajectory rotates links by {:.4g} rad up to point {}, and by {:.3g} rad before it; at most {} "
          "rad in addition to {:g} rad per point can be checked",
          turned, i, angle, kMaxAddedWaypoints, kAngle));
    }
    const auto count = static_cast<std::size_t>(pieces);
    added += count - 1;
    for (std::size_t piece = 1; piece < count; ++piece) {
      waypoints.push_back(times[i - 1] + static_cast<double>(piece) / pieces * (times[i] - times[i - 1]));
    }
    waypoints.push_back(times[i]);
  }
  return waypoints;
}

std::vector<double> TrajectoryMotion::jointErrors() const {
  std::vector<double> errors(bodies_.size(), 0.0);
  if (trajectory_.joint_error == 0.0) return errors;
  std::vector<double> farthest(robot_.links().size(), 0.0);  // per link: from its origin to its joint [m]
  std::vector<FrameMove> moves;
  for (std::size_t i = 1; i < trajectory_.times.size(); ++i) {
    moveAlong(i, moves);
    for (std::size_t link = 1; link < moves.size(); ++link) {
      farthest[link] = std::max({farthest[link], moves[link].X_start.translation().norm(), moves[link].t_end.norm()});
    }
  }
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const CarriedBody& carried = bodies_[body];
    double reach = (carried.X_LB * carried.ball_B.center).norm() + carried.ball_B.radius;  // from the link's origin
    for (int link = carried.link; link > 0; link = robot_.parent(link)) {
      const urdf::Joint& joint = robot_.jointAbove(link);
      const bool is_followed = trajectory_.states[0].positions.count(robot_.leader(joint).name) > 0;
      const double error = is_followed ? std::abs(robot_.multiplier(joint)) * trajectory_.joint_error : 0.0;
      if (rotates(joint)) errors[body] += error * reach;
      if (joint.type == urdf::Joint::PRISMATIC) errors[body] += error;
      reach += farthest[link] + error + toEigen(joint.parent_to_joint_origin_transform).translation().norm();
    }
  }
  return errors;
}

MotionSource TrajectoryMotion::source() {
  return {[this](double time, std::vector<Isometry3d>& X_WB) { posesAt(time, X_WB); },
          [this](double start, double end, std::vector<double>& jerk) { jerkBounds(start, end, jerk); }};
}

void TrajectoryMotion::posesAt(double time, std::vector<Isometry3d>& X_WB) const {
  const RobotState state = stateAt(trajectory_, time);
  const std::vector<Isometry3d> X_RL = robot_.forwardKinematics(state.positions, state.poses);
  X_WB.resize(bodies_.size());
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const CarriedBody& carried = bodies_[body];
    X_WB[body] = carried.link < 0 ? carried.X_LB : state.X_WR * X_RL[carried.link] * carried.X_LB;
  }
}

void TrajectoryMotion::moveAlong(std::size_t segment, std::vector<FrameMove>& moves) const {
  const RobotState &from = trajectory_.states[segment - 1], &to = trajectory_.states[segment];
  const auto alongPoses = [](const Isometry3d& X_start, const Isometry3d& X_end) {
    const bool turns = X_start.linear() != X_end.linear();
    return FrameMove{X_start, X_end.translation(), turns ? angleBetween(X_start, X_end) : 0.0};
  };
  moves.assign(robot_.links().size(), FrameMove());
  moves[0] = alongPoses(from.X_WR, to.X_WR);
  for (std::size_t link = 1; link < moves.size(); ++link) {
    const urdf::Joint& joint = robot_.jointAbove(static_cast<int>(link));
    const auto pose = from.poses.find(joint.name);
    if (pose != from.poses.end()) {
      moves[link] = alongPoses(pose->second, to.poses.at(joint.name));
      continue;
    }
    const double start = robot_.position(joint, from.positions), end = robot_.position(joint, to.positions);
    moves[link] = {jointMotion(joint, start), jointMotion(joint, end).translation(),
                   rotates(joint) ? std::abs(end - start) : 0.0};
  }
}

void TrajectoryMotion::jerkBounds(double start, double end, std::vector<double>& jerk) {
  const std::vector<double>& times = trajectory_.times;
  const std::size_t segment = segmentAt(times, start);
  if (!(times[segment - 1] <= start && end <= times[segment])) {
    jerk.assign(bodies_.size(), kInfinity);
    return;
  }
  if (segment != segment_) {
    moveAlong(segment, moves_);
    segment_ = segment;
  }
  const double share = (end - start) / (times[segment] - times[segment - 1]);
  jerk.resize(bodies_.size());
  for (std::size_t body = 0; body < bodies_.size(); ++body) jerk[body] = this->jerk(bodies_[body], share);
}

double TrajectoryMotion::jerk(const CarriedBody& body, double share) const {
  if (body.link < 0) return 0.0;
  CarriedPoints points(body);
  for (int link = body.link; link >= 0; link = robot_.parent(link)) {
    const FrameMove& move = moves_[link];
    if (move.rests()) {
      points.carry(move.X_start);
    } else {
      points.move(move.X_start, move.t_end, move.angle, share);
    }
    if (link > 0) points.carry(toEigen(robot_.jointAbove(link).parent_to_joint_origin_transform));
  }
  return points.jerk();
}

}  // namespace sdf_ccd
