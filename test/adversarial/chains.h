#pragma once

#include <vector>

#include "adversarial/duel.h"

/// Two bodies at the ends of joint chains, moved along a planned motion.
namespace sdf_ccd::test {

/// A revolute or prismatic joint with the position q(t) = amount · law(t), t from 0 to 1 s.
struct ChainJoint {
  enum class Law { kEven, kQuintic, kSwing };

  LongPose X_parent_joint;  ///< at q = 0
  Vector3l axis = Vector3l::UnitZ();
  bool turns = true;
  Law law = Law::kEven;
  Real amount = 0;     ///< [rad] or [m]
  Real frequency = 1;  ///< of the law kSwing [rad/s]

  LongPose pose(Real time) const;
  /// Largest magnitude of the position's derivative of order 1, 2 or 3 over the whole motion.
  Real derivative(int order) const;
};

class ChainPair {
 public:
  /// Two random chains of one to seven joints.
  explicit ChainPair(Random& random);

  void shiftB(const Vector3d& by) { joints_[1].front().X_parent_joint.p += by.cast<Real>(); }

  /// The exact motion of both bodies.
  PairMotion truth(const Duel& duel) const;

  /// Samples the motion, checks it with the monitor, and judges the verdict by the exact motion.
  void play(Duel& duel, Tally& tally) const;

 private:
  using Chain = std::vector<ChainJoint>;

  static Chain randomChain(Random& random);
  static LongPose pose(const Chain& chain, Real time);
  static Real speed(const Chain& chain, const Pieces& pieces);

  Chain joints_[2];  ///< of bodies A and B
  std::vector<double> waypoints_;
};

}  // namespace sdf_ccd::test
