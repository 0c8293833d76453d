#include "adversarial/chains.h"

#include <algorithm>
#include <cmath>

#include "motion/chain_derivatives.h"
#include "motion/sample_motion.h"

namespace sdf_ccd::test {
namespace {

constexpr int kMaxJoints = 7;

/// Rounded up, so that it stays an upper bound.
double raised(Real x) {
  return double(x) * (1.0 + 1e-15);
}

Real lawAt(const ChainJoint& joint, Real t) {
  switch (joint.law) {
    case ChainJoint::Law::kEven:
      return t;
    case ChainJoint::Law::kQuintic:
      return t * t * t * (10 + t * (-15 + 6 * t));
    case ChainJoint::Law::kSwing:
      return std::sin(joint.frequency * t);
  }
  return t;
}

}  // namespace

LongPose ChainJoint::pose(Real time) const {
  const Real q = amount * lawAt(*this, time);
  LongPose step;
  if (turns) step.R = Eigen::AngleAxis<Real>(q, axis).toRotationMatrix();
  if (!turns) step.p = q * axis;
  return X_parent_joint * step;
}

Real ChainJoint::derivative(int order) const {
  const Real quintic[] = {15.0L / 8, 10 / std::sqrt(3.0L), 60};
  switch (law) {
    case Law::kEven:
      return order == 1 ? std::abs(amount) : 0;
    case Law::kQuintic:
      return std::abs(amount) * quintic[order - 1];
    case Law::kSwing:
      return std::abs(amount) * std::pow(frequency, Real(order));
  }
  return 0;
}

ChainPair::Chain ChainPair::randomChain(Random& random) {
  Chain chain(1 + random() % kMaxJoints);
  const double largest = logUniform(random, 0.05, 3.0);
  const int laws = int(random() % 4);  // three: each joint has a random law
  for (ChainJoint& joint : chain) {
    joint.X_parent_joint = LongPose(test::pose(random, 3.0, 0.15));
    joint.axis = direction(random).cast<Real>().normalized();
    joint.turns = random() % 5 != 0;
    joint.law = ChainJoint::Law(laws < 3 ? laws : int(random() % 3));
    joint.amount = uniform(random, -largest, largest) * (joint.turns ? 1.0 : 0.1);
    joint.frequency = uniform(random, 1.0, 12.0);
    if (joint.law == ChainJoint::Law::kSwing) joint.amount /= joint.frequency;
  }
  chain.front().X_parent_joint.p += (0.2 * direction(random)).cast<Real>();
  return chain;
}

ChainPair::ChainPair(Random& random) : joints_{randomChain(random), randomChain(random)}, waypoints_{0.0} {
  for (double t = uniform(random, 0.1, 1.0); t < 1.0; t += uniform(random, 0.1, 1.0)) waypoints_.push_back(t);
  waypoints_.push_back(1.0);
}

LongPose ChainPair::pose(const Chain& chain, Real time) {
  LongPose X;
  for (const ChainJoint& joint : chain) X = X * joint.pose(time);
  return X;
}

Real ChainPair::speed(const Chain& chain, const Pieces& pieces) {
  Real reach = 0, speed = 0;
  for (const Convex& piece : pieces)
    for (const Vector3l& p : piece.corners) reach = std::max(reach, p.norm());
  for (auto joint = chain.rbegin(); joint != chain.rend(); ++joint) {
    speed += joint->derivative(1) * (joint->turns ? reach : 1);
    reach += joint->X_parent_joint.p.norm() + (joint->turns ? 0 : std::abs(joint->amount));
  }
  return speed;
}

PairMotion ChainPair::truth(const Duel& duel) const {
  PairMotion motion(duel.a().solid, duel.b().solid);
  const Chain &a = joints_[0], &b = joints_[1];
  motion.add(
      0, 1, [a](Real t) { return pose(a, t); }, [b](Real t) { return pose(b, t); },
      speed(a, duel.a().solid) + speed(b, duel.b().solid));
  return motion;
}

void ChainPair::play(Duel& duel, Tally& tally) const {
  std::vector<BoundingBall> balls;
  for (const Body& body : duel.scene().bodies) balls.push_back(body.ball);
  const MotionSource source{
      [&](double time, std::vector<Isometry3d>& X_WB) {
        X_WB = {rounded(pose(joints_[0], time)), rounded(pose(joints_[1], time))};
      },
      [&](double start, double end, std::vector<double>& jerk) {
        jerk.clear();
        for (int body = 0; body < 2; ++body) {
          ChainDerivatives derivatives(balls[std::size_t(body)]);
          const Chain& chain = joints_[body];
          for (auto joint = chain.rbegin(); joint != chain.rend(); ++joint) {
            const double h = end - start;
            const DerivativeBounds moves{raised(joint->derivative(1)) * h, raised(joint->derivative(2)) * h * h,
                                         raised(joint->derivative(3)) * h * h * h};
            const Real reach = joint->X_parent_joint.p.norm() + (joint->turns ? 0 : std::abs(joint->amount));
            derivatives.addFrame(raised(reach), joint->turns ? moves : DerivativeBounds{},
                                 joint->turns ? DerivativeBounds{} : moves);
          }
          jerk.push_back(derivatives.jerk());
        }
      }};
  CycleMotion motion;
  sampleMotion(waypoints_, source, balls, {2e-4, 7}, motion);
  duel.monitor().reset();
  const PairResult& result = duel.monitor().run(motion, {false, 0}).pairs.at(0);
  const PairMotion moves = truth(duel);
  duel.judge(moves, moves, result, duel.name() + " chains", tally);
}

}  // namespace sdf_ccd::test
