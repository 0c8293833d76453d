#pragma once

#include <cstdint>
#include <vector>

#include "flat_piece.h"
#include "surface_sides.h"

namespace sdf_ccd {

/// A convex part of a triangle whose sides are the same all over it.
struct SurfacePart {
  FlatPiece piece;
  Sides sides;
  bool tells_sides = true;  ///< false: near-by faces, nearly on this one, make the side that is nearest doubtful
};

/// Cuts triangles of a closed mesh along the planes of those that cross them, and along the edges of those that lie on
/// them, until nothing crosses a part; then tells the part's sides.
///
/// Nothing crosses a part but within a strip along its border as wide as the tolerance: so wide at most is what is
/// told wrongly. What cannot be told is kUnknown.
class TriangleCutter {
 public:
  TriangleCutter(const TriangleMesh& mesh, const TriangleTree& tree, const Interior& interior,
                 const SurfaceTolerance& tolerance)
      : mesh_(mesh), tolerance_(tolerance), test_(tree, interior, tolerance) {}

  /// What a triangle costs, or may cost at most.
  struct Cost {
    std::size_t steps = 0;   ///< in each of which one other is compared with one part
    std::size_t visits = 0;  ///< of nodes and triangles to tell parts' sides
  };
  struct Result {
    std::vector<SurfacePart> parts;  ///< that cover the triangle; none if it may not cost enough
    Cost cost;
  };
  /// Neighbouring parts of like sides are joined where one cut has made them.
  /// @param others  that cut it or lie on it, ascending.
  Result parts(int triangle, const std::vector<int>& others, const Cost& most) const;

 private:
  class Task;

  const TriangleMesh& mesh_;
  SurfaceTolerance tolerance_;
  SideTest test_;
};

}  // namespace sdf_ccd
