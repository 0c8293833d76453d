#include "robot_monitor/robot_pair_traits.h"

#include <algorithm>
#include <variant>

#include "robot/joint_chain.h"

namespace sdf_ccd {
namespace {

BoundingBall ballInLink(const Body& body) {
  return {body.X_frame_B * body.ball.center, body.ball.radius};
}

/// Whether a rotation about the axis leaves the body as it is. @param axis  in the body's frame.
bool isOfRevolution(const BodyDescription& body, const Axis& axis) {
  constexpr double kSame = 1e-9;  // [m, rad]
  const auto isOnAxis = [&](const Vector3d& p_B) { return (p_B - axis.origin).cross(axis.direction).norm() < kSame; };
  return std::all_of(body.geometry.begin(), body.geometry.end(), [&](const GeometryDescription& geometry) {
    const auto* primitive = std::get_if<Primitive>(&geometry.shape);
    if (!primitive || !isOnAxis(geometry.X_BG.translation())) return false;
    if (std::holds_alternative<Sphere>(*primitive)) return true;
    const Vector3d z_B = geometry.X_BG.linear() * Vector3d::UnitZ();
    return std::holds_alternative<Cylinder>(*primitive) && z_B.cross(axis.direction).norm() < kSame;
  });
}

bool isSame(const BoundingBall& a, const BoundingBall& b) {
  return a.center == b.center && a.radius == b.radius;
}

}  // namespace

RobotPairTraits::RobotPairTraits(std::shared_ptr<const RobotModel> robot, LinkOfFrame link_of_frame,
                                 std::vector<PairLimit> limits)
    : robot_(std::move(robot)), link_of_frame_(std::move(link_of_frame)), limits_(std::move(limits)) {
  if (robot_) X_RL_ = robot_->forwardKinematics({});
}

std::vector<PairTraits> RobotPairTraits::of(const Scene& scene, const SceneDescription& description) {
  std::vector<PairTraits> all(scene.pairs.size());
  KnownSpeeds next;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const PlannedPair& pair = scene.pairs[i];
    PairTraits& traits = all[i];
    const Body &a = scene.bodies[pair.body_a], &b = scene.bodies[pair.body_b];
    for (const PairLimit& limit : limits_)
      if (limit.stop_distance && matches(limit.bodies, a.name, b.name)) traits.stop_distance = limit.stop_distance;
    traits.is_own = !a.is_world && !b.is_world;
    if (!traits.is_own || linkOf(a) < 0 || linkOf(b) < 0) continue;
    traits.max_closing = maxClosing(a, b, next);
    traits.is_constant = traits.max_closing == 0.0 || isConstant(description, scene, pair);
  }
  speeds_.swap(next);
  return all;
}

bool RobotPairTraits::isConstant(const SceneDescription& description, const Scene& scene,
                                 const PlannedPair& pair) const {
  const int link_a = linkOf(scene.bodies[pair.body_a]);
  const std::optional<Axis> axis_A = commonAxis(*robot_, X_RL_, link_a, linkOf(scene.bodies[pair.body_b]));
  if (!axis_A) return false;
  const auto turnsInItself = [&](int index) {
    const Body& body = scene.bodies[index];
    const Isometry3d X_BA = (X_RL_[static_cast<std::size_t>(linkOf(body))] * body.X_frame_B).inverse() *
                            X_RL_[static_cast<std::size_t>(link_a)];
    return isOfRevolution(description.bodies[static_cast<std::size_t>(index)],
                          {X_BA * axis_A->origin, X_BA.linear() * axis_A->direction});
  };
  return turnsInItself(pair.body_a) || turnsInItself(pair.body_b);
}

double RobotPairTraits::maxClosing(const Body& a, const Body& b, KnownSpeeds& next) const {
  const BoundingBall ball_a = ballInLink(a), ball_b = ballInLink(b);
  const auto known = speeds_.find({a.name, b.name});
  const bool is_known =
      known != speeds_.end() && isSame(known->second.ball_a, ball_a) && isSame(known->second.ball_b, ball_b);
  const double speed = is_known ? known->second.speed : maxClosingSpeed(*robot_, linkOf(a), ball_a, linkOf(b), ball_b);
  next[{a.name, b.name}] = {ball_a, ball_b, speed};
  return speed;
}

}  // namespace sdf_ccd
