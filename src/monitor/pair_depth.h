#pragma once

#include <array>
#include <optional>
#include <vector>

#include "relative_motion.h"
#include "sdf_ccd/monitor.h"
#include "surface/depth_search.h"

namespace sdf_ccd {

/// Measures the greatest depth of a pair: the largest distance of a point of either surface inside the other body's
/// solid from that solid's boundary. Keeps from cycle to cycle where the surfaces were deep.
class PairDepth {
 public:
  /// Whether both bodies have solids (Body::solid, or a single half-space).
  static bool isPossible(const Body& a, const Body& b);

  /// isPossible() must hold, and the bodies must outlive this.
  /// @param resolution  no point is deeper than the deepest found by more than this, unless that takes too long [m].
  PairDepth(const Body& a, const Body& b, double resolution);

  /// Scratch memory of run().
  using Memory = std::array<std::vector<RelativeMotionBounds>, 2>;

  struct Found {
    /// With its depth, its time, and an error up to which no point is deeper; no depth if no point is inside.
    ContactPoint deepest;
    double certain = 0.0;     ///< deeper points certainly are inside [m]
    double throughout = 0.0;  ///< some point is as deep all the time, if positive [m]
  };

  /// Over a motion. @param error  of the bodies' relative position [m].
  Found run(const PairMotion& pair, double error, Memory& memory);

  /// In the motion of run(): the deepest point during a part of it, as the one of all; and how deep the deepest point
  /// of all is at a time [m].
  ///@{
  ContactPoint deepestWithin(const Interval& times, double error);
  double depthAt(double time) const;
  ///@}

  /// Discards what is known from earlier cycles.
  void forget();

 private:
  /// The surface of body P, inside the solid of body F.
  struct Direction {
    bool f_is_a;
    std::shared_ptr<const DepthSolid> solid;
    RelativeMotion motion;
    DepthSearch search;
    std::optional<Isometry3d> X_FP;  // at the end of the last motion
  };
  /// A point of a surface.
  struct Place {
    std::size_t direction;
    Vector3d p_P;
  };

  void restart();
  void addDirection(const Body& f, const Body& p, bool f_is_a, double resolution);
  double offer(const Place& place, std::size_t step, double s);
  double search(const Interval& times);
  ContactPoint deepestPoint(double highest, double error) const;

  std::vector<Direction> directions_;
  double deviation_ = 0.0;      // of both surfaces [m]
  std::optional<Place> known_;  // the deepest in the last motion

  // Of this motion:
  DeepestPoint best_;
  std::size_t best_direction_ = 0, best_step_ = 0;
};

}  // namespace sdf_ccd
