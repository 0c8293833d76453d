#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adversarial/family.h"
#include "oracle/pair_motion.h"
#include "oracle/random.h"
#include "sdf_ccd/monitor.h"

/// Two bodies checked by a monitor, and their exact separation.
namespace sdf_ccd::test {

/// A body to check, and its exact solid as convex pieces in its own frame.
struct Actor {
  std::string kind;
  std::vector<GeometryDescription> geometry;
  Pieces solid;  ///< certainly solid, however inside and outside are decided
  Pieces reach;  ///< holds all that may be solid; empty: the same as `solid`

  bool is_convex = false;      ///< `solid` is one convex piece, so that depths are known
  bool is_field_only = false;  ///< no shell can be made of it

  const Pieces& outer() const { return reach.empty() ? solid : reach; }
  double radius() const;  ///< radius of the bounding ball about the frame's origin [m]
};

/// A convex mesh.
Actor convexActor(const std::string& kind, const TriangleMesh& mesh, const Vector3d& offset = Vector3d::Zero());
/// A box with an exact field.
Actor boxActor(const Vector3d& half_size, const Vector3d& offset = Vector3d::Zero());
Actor ballActor(double radius);

class Duel {
 public:
  Duel(Actor a, Actor b, const BodyOptions& scene, const MonitorOptions& monitor);

  /// With two more boxes far away that jump in every cycle: in a cycle without time, only their pair is tested.
  static Duel inCompany(Actor a, Actor b, const BodyOptions& scene, const MonitorOptions& monitor);

  const Actor& a() const { return a_; }
  const Actor& b() const { return b_; }
  const Scene& scene() const { return monitor_->scene(); }
  Monitor& monitor() { return *monitor_; }
  double bound() const { return bound_; }  ///< planned error bound of the pair's verdict [m]
  double size() const { return size_; }    ///< sum of both bodies' radii [m]
  std::string name() const { return a_.kind + " - " + b_.kind; }

  /// Resets the monitor, checks a motion of the two bodies and judges the result.
  const PairResult& play(const CycleMotion& motion, Tally& tally);

  /// Checks a motion that continues the previous one, without a reset.
  /// @param has_time  false for a cycle in which only one pair is tested; only for duels made by inCompany().
  const PairResult& follow(const CycleMotion& motion, bool has_time = true);

  /// Compares the monitor's result for a motion with the truth over the pair's span, and counts it in `tally`.
  /// @param what  names the case in failures.
  void judge(const CycleMotion& motion, const PairResult& result, const std::string& what, Tally& tally) const;

  /// The same for bodies that do not move with constant twists between the motion's poses.
  /// @param solid  motion of the certain solids. @param outer  motion of the pieces that hold all that may be solid.
  /// @param off  upper bound of the sum of both bodies' deviations from the poses given to the monitor [m].
  void judge(const PairMotion& solid, const PairMotion& outer, const PairResult& result, const std::string& what,
             Tally& tally, Real off = 0) const;

  /// Bounds of the minimum separation of the solids over a span [m], to the tolerance of the options.
  LeastValue least(const CycleMotion& motion, const WaypointSpan& span, const LeastOptions& options) const;

  /// Moves body B so that the minimum separation is `wanted` [m], to about a tenth of the error bound.
  /// @return the direction of that move: from A to B at their closest approach.
  Vector3d aim(double wanted, CycleMotion& motion) const;
  Vector3d aim(double wanted, const std::function<PairMotion()>& motion,
               const std::function<void(const Vector3d&)>& shift) const;

 private:
  Duel(Actor a, Actor b, const BodyOptions& scene, const MonitorOptions& monitor, bool in_company);
  PairMotion motionOf(const CycleMotion& motion, const WaypointSpan& span, bool outer) const;
  void judgeClear(const PairMotion& solid, const PairResult& result, const std::string& what, Tally& tally) const;
  void judgePostponed(const PairMotion& solid, const PairResult& result, const std::string& what, Tally& tally) const;
  void judgeNear(const PairMotion& outer, const PairResult& result, Real off, const std::string& what,
                 Tally& tally) const;
  void judgeContact(const PairMotion& outer, const PairResult& result, const std::string& what, Tally& tally) const;
  void judgeDepth(const PairMotion& solid, const PairResult& result, const std::string& what, Tally& tally) const;
  Real rounding(const PairMotion& motion) const;

  Actor a_, b_;
  std::unique_ptr<Monitor> monitor_;
  double bound_ = 0.0, size_ = 0.0;
  bool in_company_;
  long cycles_ = 0;
};

/// A motion with the poses of both bodies equally spaced over one second.
CycleMotion pairCycle(std::vector<Isometry3d> X_WA, std::vector<Isometry3d> X_WB);

/// Shifts body B of a motion of two.
void shiftB(const Vector3d& by, CycleMotion& motion);

/// A pose after a rotation about a world axis through `point`, followed by `shift`.
Isometry3d screwed(const Isometry3d& X, const Vector3d& point, const Vector3d& rotation_vector, const Vector3d& shift);

/// A random number, log-uniform in [low, high].
double logUniform(Random& random, double low, double high);

}  // namespace sdf_ccd::test
