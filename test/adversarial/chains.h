#pragma once

#include <vector>

#include "adversarial/duel.h"

/// Two bodies at the ends of chains of joints, as a planned motion moves them.
namespace sdf_ccd::test {

/// A joint that turns about, or slides along, an axis: q(t) = amount · law(t) from time 0 to 1 [s].
struct ChainJoint {
  enum class Law { kEven, kQuintic, kSwing };

  LongPose X_parent_joint;  ///< at rest
  Vector3l axis = Vector3l::UnitZ();
  bool turns = true;
  Law law = Law::kEven;
  Real amount = 0;     ///< [rad] or [m]
  Real frequency = 1;  ///< of a swing [rad/s]

  LongPose pose(Real time) const;
  /// No derivative of the order is greater: the law's first three are known in full.
  Real derivative(int order) const;
};

class ChainPair {
 public:
  /// One to seven joints each.
  explicit ChainPair(Random& random);

  void shiftB(const Vector3d& by) { joints_[1].front().X_parent_joint.p += by.cast<Real>(); }

  PairMotion truth(const Duel& duel) const;

  /// Samples the motion, checks it, and judges the verdict by the joints' motion.
  void play(Duel& duel, Tally& tally) const;

 private:
  using Chain = std::vector<ChainJoint>;

  static Chain randomChain(Random& random);
  static LongPose pose(const Chain& chain, Real time);
  static Real speed(const Chain& chain, const Pieces& pieces);

  Chain joints_[2];  ///< of A and of B
  std::vector<double> waypoints_;
};

}  // namespace sdf_ccd::test
