#include "unreachable_pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/number_text.h"
#include "geometry_extent.h"
#include "model/name_pair.h"
#include "motion/screw_motion.h"
#include "motion/two_body_motion.h"
#include "urdf_geometry.h"

namespace sdf_ccd {

const char* const kOutOfReach = "out of reach";
const char* const kRigidlyJoined = "rigidly joined";

namespace {

/// Why a prismatic joint's assumed range does not hold in a state; empty if it does.
std::string beyond(const RobotModel& robot, const RobotState& state, const RobotModel::Slide& slide) {
  const urdf::Joint& joint = *robot.urdf().getJoint(slide.joint);
  const auto pose = state.poses.find(slide.joint);
  if (pose == state.poses.end() && !state.positions.count(robot.leader(joint).name)) {
    return std::string(kOutOfReach) + " by joint " + slide.joint + ", which is not known";
  }
  const Isometry3d X_PJ = toEigen(joint.parent_to_joint_origin_transform);
  const double position =
      pose == state.poses.end() ? robot.position(joint, state.positions) : robot.positionAt(joint, X_PJ * pose->second);
  return beyondReach(slide, position);
}

/// Lower bound of the distance of two points that move along screws, from their positions at both ends.
double distanceBound(const ScrewMotion& X_WA, const Vector3d& p_A, const ScrewMotion& X_WB, const Vector3d& p_B) {
  const double start = (X_WA.start() * p_A - X_WB.start() * p_B).norm();
  const double end = (X_WA.end() * p_A - X_WB.end() * p_B).norm();
  return 0.5 * (start + end - X_WA.maxTravel({p_A, 0.0}) - X_WB.maxTravel({p_B, 0.0}));
}

}  // namespace

bool isProof(const std::string& reason) {
  return reason == kRigidlyJoined || reason == kOutOfReach;
}

std::string beyondReach(const RobotModel::Slide& slide, double position) {
  if (slide.low <= position && position <= slide.high) return {};
  return std::string(kOutOfReach) + " only while joint " + slide.joint + " is in [" + numberText(slide.low) + ", " +
         numberText(slide.high) + "]; it is at " + numberText(position);
}

bool areJoinedAt(const UnreachablePair& pair, const Isometry3d& X_AB) {
  constexpr double kMoved = 1e-3;  // calibrated robots differ by less from their URDF [m]
  const Isometry3d& expected = *pair.X_AB;
  // Where they meet, both have points. Of a half-space nothing follows: it is infinite.
  return maxDisplacement(expected, X_AB, pair.ball_b) <= kMoved ||
         maxDisplacement(expected.inverse(), X_AB.inverse(), pair.ball_a) <= kMoved;
}

std::vector<UnreachablePair> unreachablePairs(const RobotModel& robot, const std::vector<BodyDescription>& bodies,
                                              const std::vector<AllowedPair>& allowed, const std::string& prefix) {
  const std::vector<Isometry3d> X_RL = robot.forwardKinematics({});
  std::map<std::string, Isometry3d> X_RF;
  for (std::size_t i = 0; i < X_RL.size(); ++i) X_RF[prefix + robot.links()[i]] = X_RL[i];
  std::map<std::string, int> index;
  for (std::size_t i = 0; i < bodies.size(); ++i) index[bodies[i].name] = static_cast<int>(i);
  const auto linkOf = [&](int body) { return bodies[body].is_world ? robot.root() : bodies[body].name; };
  std::map<int, BoundingBall> balls;
  const auto ballOfBody = [&](int body) {
    const auto [ball, is_new] = balls.try_emplace(body);
    if (is_new) ball->second = extentBall(bodies[body].geometry);
    return ball->second;
  };
  std::vector<UnreachablePair> pairs;
  for (const AllowedPair& left_out : allowed) {
    UnreachablePair pair;
    pair.body_a = index.at(left_out.body_a);
    pair.body_b = index.at(left_out.body_b);
    const BodyDescription &a = bodies[pair.body_a], &b = bodies[pair.body_b];
    if (left_out.reason == kRigidlyJoined && X_RF.count(a.frame) > 0 && X_RF.count(b.frame) > 0) {
      pair.X_AB = relativePose(X_RF[a.frame] * a.X_frame_B, X_RF[b.frame] * b.X_frame_B);
    } else if (left_out.reason == kOutOfReach) {
      pair.slides = robot.slidesBetween(linkOf(pair.body_a), linkOf(pair.body_b));
    } else {
      continue;
    }
    pair.ball_a = ballOfBody(pair.body_a);
    pair.ball_b = ballOfBody(pair.body_b);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<UnreachablePair> withoutAllowed(std::vector<UnreachablePair> pairs, const SceneDescription& scene) {
  std::set<NamePair> may_touch;
  for (const AllowedPair& pair : scene.allowed)
    if (pair.proved && !isProof(pair.reason)) may_touch.insert(namePair(pair.body_a, pair.body_b));
  const auto mayTouch = [&](const UnreachablePair& pair) {
    return may_touch.count(namePair(scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name)) > 0;
  };
  if (!may_touch.empty()) pairs.erase(std::remove_if(pairs.begin(), pairs.end(), mayTouch), pairs.end());
  return pairs;
}

std::vector<UncheckedPair> reachableAlong(const RobotModel& robot, const PlannedJoints& plan,
                                          const std::vector<UnreachablePair>& pairs) {
  std::vector<UncheckedPair> unchecked;
  for (const UnreachablePair& pair : pairs) {
    std::string reason;
    for (const RobotModel::Slide& slide : pair.slides) {
      for (const RobotState& state : plan.trajectory.states) {
        if (reason.empty()) reason = beyond(robot, state, slide);
      }
    }
    if (!reason.empty()) unchecked.push_back({pair.body_a, pair.body_b, reason});
  }
  return unchecked;
}

std::vector<UncheckedPair> reachableAlong(const CycleMotion& motion, const std::vector<bool>& is_moved,
                                          const std::vector<UnreachablePair>& pairs) {
  std::vector<UncheckedPair> unchecked;
  for (const UnreachablePair& pair : pairs) {
    const int a = pair.body_a, b = pair.body_b;
    if (!is_moved[a] && !is_moved[b]) continue;
    const bool is_known = motion.missing[a].empty() && motion.missing[b].empty();
    if (pair.X_AB) {
      bool are_joined = is_known;
      for (std::size_t i = 0; i < motion.times.size() && are_joined; ++i)
        are_joined = areJoinedAt(pair, relativePose(motion.pose(a, i), motion.pose(b, i)));
      if (!are_joined)
        unchecked.push_back({a, b, std::string(kRigidlyJoined) + " in the URDF, but not in these poses"});
      continue;
    }
    bool may_meet = !is_known;
    for (std::size_t i = 1; i < motion.times.size() && !may_meet; ++i) {
      const ScrewMotion X_WA(motion.pose(a, i - 1), motion.pose(a, i)), X_WB(motion.pose(b, i - 1), motion.pose(b, i));
      may_meet = !(distanceBound(X_WA, pair.ball_a.center, X_WB, pair.ball_b.center) >
                   pair.ball_a.radius + pair.ball_b.radius);
    }
    if (may_meet)
      unchecked.push_back({a, b, std::string(kOutOfReach) + " for the robot's joints, but not for these poses"});
  }
  return unchecked;
}

}  // namespace sdf_ccd
