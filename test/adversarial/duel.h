#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adversarial/family.h"
#include "oracle/pair_motion.h"
#include "oracle/random.h"
#include "sdf_ccd/monitor/monitor.h"

/// Two bodies under a monitor, and what is true of them.
namespace sdf_ccd::test {

/// A body to be checked, and its solid as convex pieces in its own frame.
struct Actor {
  std::string kind;
  std::vector<GeometryDescription> geometry;
  Pieces solid;  ///< who is there meets it, however sides are told
  Pieces reach;  ///< who is outside of it does not meet it, however sides are told; empty: the same as `solid`

  bool is_convex = false;      ///< `solid` is one convex solid: depths in it are known
  bool is_field_only = false;  ///< no shell can be made of it

  const Pieces& outer() const { return reach.empty() ? solid : reach; }
  double radius() const;  ///< of a ball about the frame's origin that holds it [m]
};

/// A mesh that is convex.
Actor convexActor(const std::string& kind, const TriangleMesh& mesh, const Vector3d& offset = Vector3d::Zero());
/// A box with an exact field.
Actor boxActor(const Vector3d& half_size, const Vector3d& offset = Vector3d::Zero());
Actor ballActor(double radius);

class Duel {
 public:
  Duel(Actor a, Actor b, const BodyOptions& scene, const MonitorOptions& monitor);

  /// Besides, two boxes far away that jump every cycle: their pair takes the time of a cycle that has none.
  static Duel inCompany(Actor a, Actor b, const BodyOptions& scene, const MonitorOptions& monitor);

  const Actor& a() const { return a_; }
  const Actor& b() const { return b_; }
  const Scene& scene() const { return monitor_->scene(); }
  Monitor& monitor() { return *monitor_; }
  double bound() const { return bound_; }  ///< of a pair's verdict, as planned [m]
  double size() const { return size_; }    ///< of both bodies [m]
  std::string name() const { return a_.kind + " - " + b_.kind; }

  /// Forgets clearances, checks the motion and judges the verdict. `motion` has two bodies.
  const PairResult& play(const CycleMotion& motion, Tally& tally);

  /// Checks the motion, with what is known since the last one. In company: `has_time` is false of a cycle in which one
  /// pair alone is tested.
  const PairResult& follow(const CycleMotion& motion, bool has_time = true);

  /// Judges what the monitor said about a motion: by the pair's span of it.
  /// @param what  how to see it again.
  void judge(const CycleMotion& motion, const PairResult& result, const std::string& what, Tally& tally) const;

  /// The same where the bodies move otherwise than by constant twists between the motion's poses.
  /// @param off  how far both may be from where the monitor was told they are, together [m].
  void judge(const PairMotion& solid, const PairMotion& outer, const PairResult& result, const std::string& what,
             Tally& tally, Real off = 0) const;

  /// Least separation of the solids over the pair's span [m], as near as wanted.
  LeastValue least(const CycleMotion& motion, const WaypointSpan& span, const LeastOptions& options) const;

  /// Moves body B so that the least separation is `wanted` [m], to about a tenth of the bound.
  /// @return the direction that it was moved along, the way from A to B where they are nearest.
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

/// Poses of both bodies evenly over a second.
CycleMotion pairCycle(std::vector<Isometry3d> X_WA, std::vector<Isometry3d> X_WB);

/// Shifts body B of a motion of two.
void shiftB(const Vector3d& by, CycleMotion& motion);

/// A pose after `angle` about an axis of the world through a point, and `shift` along with it.
Isometry3d screwed(const Isometry3d& X, const Vector3d& point, const Vector3d& rotation_vector, const Vector3d& shift);

/// Random, evenly in the logarithm.
double logUniform(Random& random, double low, double high);

}  // namespace sdf_ccd::test
