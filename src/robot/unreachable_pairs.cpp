#include "unreachable_pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "common/infinity.h"
#include "common/number_text.h"
#include "geometry_extent.h"
#include "model/name_pair.h"
#include "motion/screw_motion.h"
#include "motion/two_body_motion.h"
#include "urdf_geometry.h"

namespace sdf_ccd {

namespace {

/// A joint's position in a state [m]; empty if it is not known.
std::optional<double> positionIn(const RobotModel& robot, const RobotState& state, const urdf::Joint& joint) {
  const auto pose = state.poses.find(joint.name);
  if (pose != state.poses.end())
    return robot.positionAt(joint, toEigen(joint.parent_to_joint_origin_transform) * pose->second);
  if (state.positions.count(robot.leader(joint).name) == 0) return std::nullopt;
  return robot.position(joint, state.positions);
}

/// Lower bound of the distance of two points that move along screws, from their positions at both ends.
double distanceBound(const ScrewMotion& X_WA, const Vector3d& p_A, const ScrewMotion& X_WB, const Vector3d& p_B) {
  const double start = (X_WA.start() * p_A - X_WB.start() * p_B).norm();
  const double end = (X_WA.end() * p_A - X_WB.end() * p_B).norm();
  return 0.5 * (start + end - X_WA.maxTravel({p_A, 0.0}) - X_WB.maxTravel({p_B, 0.0}));
}

}  // namespace

std::string beyondReach(const SlideRange& slide, double position) {
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

void addProofs(const RobotModel& robot, const std::vector<BodyDescription>& bodies, std::vector<AllowedPair>& allowed,
               const std::string& prefix) {
  const auto lacksProof = [](const AllowedPair& pair) { return pair.proved && !pair.proof; };
  if (std::none_of(allowed.begin(), allowed.end(), lacksProof)) return;
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
  for (AllowedPair& pair : allowed) {
    if (!lacksProof(pair)) continue;
    const int body_a = index.at(pair.body_a), body_b = index.at(pair.body_b);
    const BodyDescription &a = bodies[body_a], &b = bodies[body_b];
    PairProof proof;
    if (pair.reason == kOutOfReach) {
      proof.slides = robot.slidesBetween(linkOf(body_a), linkOf(body_b));
    } else if (X_RF.count(a.frame) > 0 && X_RF.count(b.frame) > 0) {
      proof.X_AB = relativePose(X_RF[a.frame] * a.X_frame_B, X_RF[b.frame] * b.X_frame_B);
    } else {
      continue;
    }
    proof.ball_a = ballOfBody(body_a);
    proof.ball_b = ballOfBody(body_b);
    pair.proof = std::make_shared<const PairProof>(std::move(proof));
  }
}

std::vector<UnreachablePair> unreachablePairs(const std::vector<BodyDescription>& bodies,
                                              const std::vector<AllowedPair>& allowed) {
  std::map<std::string, int> index;
  for (std::size_t i = 0; i < bodies.size(); ++i) index[bodies[i].name] = static_cast<int>(i);
  std::vector<UnreachablePair> pairs;
  for (const AllowedPair& pair : allowed)
    if (pair.proof && isProof(pair.reason))
      pairs.push_back({*pair.proof, index.at(pair.body_a), index.at(pair.body_b)});
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

JointReach::JointReach(const RobotModel& robot, const PlannedJoints& plan, const std::vector<CarriedBody>& bodies) {
  std::vector<int> rigid_root;  // per link
  for (int link = 0; link < static_cast<int>(robot.links().size()); ++link) {
    const bool is_root = link == 0;
    const bool is_fixed = !is_root && robot.jointAbove(link).type == urdf::Joint::FIXED;
    rigid_root.push_back(is_fixed ? rigid_root[robot.parent(link)] : link);
    if (is_root || robot.jointAbove(link).type != urdf::Joint::PRISMATIC) continue;
    const urdf::Joint& joint = robot.jointAbove(link);
    Range& range = ranges_[joint.name] = {kInfinity, -kInfinity, true};
    for (const RobotState& state : plan.trajectory.states) {
      const std::optional<double> position = positionIn(robot, state, joint);
      range.is_known &= position && std::isfinite(*position);
      range.low = std::min(range.low, position.value_or(range.low));
      range.high = std::max(range.high, position.value_or(range.high));
    }
  }
  for (const CarriedBody& body : bodies) group_.push_back(body.link < 0 ? -1 : rigid_root[body.link]);
}

std::string JointReach::whyReachable(const UnreachablePair& pair) const {
  const int group_a = group_[pair.body_a], group_b = group_[pair.body_b];
  if (pair.X_AB) return group_a == group_b ? "" : std::string(kRigidlyJoined) + " in the URDF, but not in this motion";
  if (group_a < 0 || group_b < 0)
    return std::string(kOutOfReach) + " for the robot's joints, but the robot does not carry both of them";
  for (const SlideRange& slide : pair.slides) {
    const auto found = ranges_.find(slide.joint);
    if (found == ranges_.end() || !found->second.is_known)
      return std::string(kOutOfReach) + " by joint " + slide.joint + ", which is not known";
    for (const double position : {found->second.low, found->second.high})
      if (const std::string why = beyondReach(slide, position); !why.empty()) return why;
  }
  return {};
}

std::string whyReachable(const CycleMotion& motion, const std::vector<bool>& is_moved, const UnreachablePair& pair) {
  const int a = pair.body_a, b = pair.body_b;
  if (!is_moved[a] && !is_moved[b]) return {};
  const bool is_known = motion.missing[a].empty() && motion.missing[b].empty();
  if (pair.X_AB) {
    bool are_joined = is_known;
    for (std::size_t i = 0; i < motion.times.size() && are_joined; ++i)
      are_joined = areJoinedAt(pair, relativePose(motion.pose(a, i), motion.pose(b, i)));
    return are_joined ? "" : std::string(kRigidlyJoined) + " in the URDF, but not in these poses";
  }
  bool may_meet = !is_known;
  for (std::size_t i = 1; i < motion.times.size() && !may_meet; ++i) {
    const ScrewMotion X_WA(motion.pose(a, i - 1), motion.pose(a, i)), X_WB(motion.pose(b, i - 1), motion.pose(b, i));
    may_meet = !(distanceBound(X_WA, pair.ball_a.center, X_WB, pair.ball_b.center) >
                 pair.ball_a.radius + pair.ball_b.radius);
  }
  return may_meet ? std::string(kOutOfReach) + " for the robot's joints, but not for these poses" : "";
}

}  // namespace sdf_ccd
