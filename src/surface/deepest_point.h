#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "motion/chords.h"
#include "part_depth.h"
#include "surface/box_tree.h"

namespace sdf_ccd {

/// The surface that penetrates: its triangles, and the elements of its own body, which may hide some of them.
struct EnteringSurface {
  const BoxTree* triangles;
  std::vector<SolidPart> parts;  ///< empty: no triangle is hidden
};

struct DeepestPoint {
  double depth = 0.0;                 ///< of this point [m]
  int motion = -1;                    ///< index of the motion, in the order of add()
  double s = 0.0;                     ///< time, from 0 to 1
  Vector3d p_F = Vector3d::Zero();    ///< position in the solid's frame
  Vector3d out_F = Vector3d::Zero();  ///< unit: the solid's outward normal at its nearest surface point
};

/// Finds the deepest point of moving surfaces inside a solid, and its time (design §3.17), by branch and bound over
/// the surfaces' boxes, then over parts of their triangles and of the motions, in the order of their upper bounds.
///
/// Why the bounds hold. Over an interval of s of length h, a point is within e = a h²/8 of the chord between its
/// positions at both ends, where a bounds its acceleration. Depth is 1-Lipschitz: within R of c it is at most D(c) + R.
/// The distance from a convex set is convex, and the depth in a mesh is at most the distance from any of its triangles:
/// over the hull of a triangle's corners at both ends it is at most the largest distance of these six corners from the
/// mesh's triangle nearest to c. The depth in a convex solid is at most the depth behind a plane that has the solid on
/// one side, which is linear. The smaller of two such bounds is at most any weighted mean of them. This mean is convex
/// too, and tighter than either bound halfway between two sides of a solid. A plane that has all of the nearby solid
/// behind it bounds the depth of parts that stick out. If a body has several elements, a point's depth is the largest
/// of its depths in them.
///
/// A ball's surface is divided into parts with three corners on it; their points are within the height of the cap over
/// the corners' plane of the triangle between them.
///
/// Points that are inside the surface's own body by more than the resolution are not on its surface and do not count.
/// Depths are exact up to rounding.
class DeepestSearch {
 public:
  /// Removes all motions and results.
  /// @param resolution  regions whose depth exceeds the deepest known point's by no more than this are skipped [m].
  void restart(double resolution);

  /// Adds the motion of a surface's frame P relative to a solid's frame F. All arguments must outlive run().
  /// @param travel  upper bound of the displacement of the surface's points in F [m].
  void add(const EnteringSurface& surface, const std::vector<SolidPart>& solid, const TwoBodyMotion& motion,
           double travel);

  /// @param max_pieces  upper bound of the number of pieces examined; what remains counts in error().
  void run(int max_pieces);

  /// Whether any point is inside the solid; if not, deepest().depth is zero.
  bool found() const { return best_.depth > 0.0; }
  const DeepestPoint& deepest() const { return best_; }

  /// Upper bound of how much deeper any point may be than deepest() [m].
  double error() const { return std::max(0.0, highest_left_ - best_.depth); }

 private:
  class MotionSearch;

  struct AddedMotion {
    const EnteringSurface& surface;
    const std::vector<SolidPart>& solid;
    TwoBodyMotion motion;
    double travel;
    std::array<Isometry3d, 3> X_FP;  // at the start, halfway and at the end

    Isometry3d poseAt(double s) const {
      const double halves = 2.0 * s;
      return halves == std::floor(halves) ? X_FP[static_cast<std::size_t>(halves)] : motion.X_FP(s);
    }
  };

  /// The boxes of a node, or a part of a triangle over a part of the motion.
  struct Piece {
    double bound;  // upper bound of the depth of its points [m]
    int motion;
    int node = -1;
    Corners corners = {};  // P's frame
    double radius = 0.0;   // all of its points are within this of the corners' triangle
    double start = 0.0, end = 1.0;
    int ball = -1;  // of a ball, or a part of its surface with corners on it: the ball's index in the surface
  };

  static bool isLess(const Piece& a, const Piece& b) { return a.bound < b.bound; }
  double sufficientBound() const { return best_.depth + resolution_; }
  bool isDone(double bound) const { return bound <= sufficientBound(); }
  void push(const Piece& piece);

  double resolution_ = 0.0;
  DeepestPoint best_;
  double highest_left_ = 0.0;  // upper bound of the depth in the regions that were skipped [m]
  std::vector<AddedMotion> added_;
  std::vector<Piece> left_;  // a heap
};

}  // namespace sdf_ccd
