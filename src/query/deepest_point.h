#pragma once

#include <algorithm>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/solid_boundary.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/motion/chords.h"

namespace sdf_ccd {

/// What depths are measured in: one element of a body, in its frame G; B is the body's.
struct SolidPart {
  Isometry3d X_GB;
  const DistanceField* field;  ///< tells what need not be measured
  const Solid* solid;          ///< of a mesh that is closed; null of a primitive, which is convex: its field is exact
};

/// The surface that goes in: its triangles, and what tells which of them are hidden inside the body itself.
struct EnteringSurface {
  const BoxTree* triangles;
  std::vector<SolidPart> parts;  ///< empty: all are taken
};

struct DeepestPoint {
  double depth = 0.0;                 ///< of this place [m]
  int way = -1;                       ///< the how manieth that was added
  double s = 0.0;                     ///< when, from 0 to 1
  Vector3d p_F = Vector3d::Zero();    ///< where, in the solid's frame
  Vector3d out_F = Vector3d::Zero();  ///< unit: the solid's outward normal, where its surface is nearest
};

/// Finds the place of moving surfaces that gets deepest into a solid, and when (design §3.17): by branch and bound over
/// the surfaces' boxes, then parts of their triangles, and over parts of the motions, the most promising first.
///
/// Why nothing deeper is missed. Over an interval of s of length h, a point is within e = a h²/8 of the chord between
/// its places at both ends, a its acceleration. A depth is 1-Lipschitz: none within R of c is deeper than D(c) + R.
/// The distance from a convex set is convex, and the depth in a mesh no more than the distance from any of its
/// triangles: over the hull of a triangle's corners at both ends it is no more than the largest of these six corners'
/// from the triangle nearest to c. The depth in a convex solid is no more than that behind a plane that holds it, which
/// is linear. Of two such bounds the lesser is no more than any mean of them, which is convex too: it tells what no
/// single one does, halfway between two sides. A plane that holds all of the solid that is near tells of what sticks
/// out. Of the elements of a body the one in which a place is deepest counts.
///
/// What lies inside the surface's own body by more than the resolution is no place of its surface. Depths are exact but
/// for rounding.
class DeepestSearch {
 public:
  /// Forgets all.
  /// @param resolution  what is no deeper than the deepest place known by this is not looked into [m].
  void restart(double resolution);

  /// Has it look along one motion of a surface's frame P against a solid's, F. All must outlive run().
  /// @param travel  no point of the surface goes farther in F [m].
  void add(const EnteringSurface& surface, const std::vector<SolidPart>& solid, const TwoBodyMotion& motion,
           double travel);

  /// @param max_pieces  of triangles and of the motions are looked at; what is left then is in the error.
  void run(int max_pieces);

  /// Whether any place is inside; else the deepest one's depth is zero.
  bool found() const { return best_.depth > 0.0; }
  const DeepestPoint& deepest() const { return best_; }

  /// No place is deeper than the deepest one by more [m].
  double error() const { return std::max(0.0, highest_left_ - best_.depth); }

 private:
  class Look;

  struct Way {
    const EnteringSurface& surface;
    const std::vector<SolidPart>& solid;
    TwoBodyMotion motion;
    double travel;
    Isometry3d X_middle;  // X_FP halfway
  };

  /// The boxes of a node, or a part of a triangle over a part of the motion.
  struct Piece {
    double bound;  // no place of it is deeper [m]
    int way;
    int node = -1;
    Corners corners = {};  // P's frame
    double radius = 0.0;
    double start = 0.0, end = 1.0;
  };

  static bool isLess(const Piece& a, const Piece& b) { return a.bound < b.bound; }
  bool isDone(double bound) const { return bound <= best_.depth + resolution_; }
  void push(const Piece& piece);

  double resolution_ = 0.0;
  DeepestPoint best_;
  double highest_left_ = 0.0;  // bound of what was not looked into [m]
  std::vector<Way> ways_;
  std::vector<Piece> left_;  // a heap
  std::vector<int> near_;    // triangles near a piece
};

}  // namespace sdf_ccd
