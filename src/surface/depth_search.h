#pragma once

#include <array>
#include <vector>

#include "depth_solid.h"
#include "motion/chords.h"
#include "surface/box_tree.h"

namespace sdf_ccd {

struct DeepestPoint {
  double depth = 0.0;                 ///< of this point [m]
  double s = 0.0;                     ///< time, from 0 to 1
  Vector3d p_P = Vector3d::Zero();    ///< frame of the surface
  Vector3d p_G = Vector3d::Zero();    ///< frame of the solid
  Vector3d out_G = Vector3d::Zero();  ///< unit: the solid's outward normal at its nearest surface point
};

/// Finds the deepest point of a moving surface inside a solid, and its time (design §3.17), by branch and bound over
/// the surface's boxes, then over parts of its triangles and of the motion, in the order of their upper bounds.
///
/// Why the bounds hold. Over an interval of s of length h, a point is within e = a h²/8 of the chord between its
/// positions at both ends, where a bounds its acceleration. Depth is 1-Lipschitz: within R of c it is at most D(c) + R.
/// Over the hull of a triangle's corners at both ends, it is at most
///  - the distance from any triangle of the solid's boundary, which is convex: its largest value at these six corners;
///  - the depth behind a plane that has all of the nearby solid behind it (DepthPlane), which is linear.
/// The smallest of several such bounds is at most any weighted mean of them. This mean is convex too; with the best
/// weights, its largest value is the exact maximum of the smallest of linear bounds.
///
/// From one motion to the next, the parts stay with their bounds: a point's depth grows by no more than it moves. So
/// only those parts are looked at again that may have become deeper than the deepest known point.
///
/// A ball's surface is divided into parts with three corners on it; their points are within the height of the cap over
/// the corners' plane of the triangle between them.
///
/// Depths are exact up to rounding.
class DepthSearch {
 public:
  /// @param surface, solid  must outlive this.
  /// @param resolution  regions whose depth exceeds the deepest known point's by no more than this are skipped [m].
  DepthSearch(const BoxTree& surface, const DepthSolid& solid, double resolution)
      : surface_(&surface), solid_(&solid), resolution_(resolution) {}

  /// Removes what is known.
  void restart();

  /// Begins a motion.
  /// @param displacement  upper bound of the displacement of the surface's points in the solid since the end of the
  /// last motion; infinite if that is not known [m].
  void begin(double displacement);

  /// A point of the surface at a time of the motion; its depth is negative outside.
  DeepestPoint pointAt(const Vector3d& p_P, const TwoBodyMotion& motion, double s) const;

  /// Searches over a motion (or the next part of one) of the surface's frame relative to that of the solid's body.
  /// @param travel  upper bound of the displacement of the surface's points in the solid [m].
  /// @param best    the deepest point known; set to a deeper one, if there is one by more than the resolution.
  /// @param pieces  upper bound of the number of pieces examined, reduced by those that were; what remains counts in
  ///                highest().
  /// @return whether a deeper point was found.
  bool run(const TwoBodyMotion& motion, double travel, DeepestPoint& best, int& pieces);

  /// Upper bound of the depth of any point of the surface since begin(), if more than the deepest known [m].
  double highest() const { return highest_; }

 private:
  class Step;

  /// A box of the surface, or a part of a triangle over a part of the motion.
  struct Piece {
    double bound = kInfinity;  // upper bound of the depth of its points [m]
    bool is_box = false;       // corners[0] is its centre, and radius its reach
    int node = -1;             // of a box: what is below it
    Corners corners = {};      // P's frame
    double radius = 0.0;       // all of its points are within this of the corners' triangle
    double start = 0.0, end = 1.0;
    int step = 0;      // the motion in which it was measured
    int ball = -1;     // of a ball, or a part of its surface with corners on it: the ball's index in the surface
    int nearest = -1;  // triangle of the solid that was near
    std::array<DepthPlane, 3> planes;
  };
  struct Kept {
    double key;  // bound less the displacement until then
    int piece;

    bool operator<(const Kept& o) const { return key < o.key; }
  };

  void push(const Piece& piece);
  Piece pop();

  const BoxTree* surface_;
  const DepthSolid* solid_;
  double resolution_;

  std::vector<Piece> pieces_;
  std::vector<int> free_;
  std::vector<Kept> left_;  // a heap
  double displaced_ = 0.0;  // upper bound of the surface's displacement since restart() [m]
  double highest_ = 0.0;
  int step_ = 0;
  bool is_complete_ = false;  // all of the surface is in left_
};

}  // namespace sdf_ccd
