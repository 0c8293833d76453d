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
  bool tells_sides = true;  ///< false: faces that nearly lie on this one make the nearest side doubtful
};

/// Cuts triangles of a closed mesh along the planes of those that cross them, and along the edges of those that lie on
/// them, until nothing crosses a part; then determines the part's sides.
///
/// Other triangles cross a part at most within a strip along its border, as wide as the tolerance; errors are limited
/// to this strip. Sides that cannot be determined are kUnknown.
class TriangleCutter {
 public:
  TriangleCutter(const TriangleMesh& mesh, const TriangleTree& tree, const Interior& interior,
                 const SurfaceTolerance& tolerance)
      : mesh_(mesh), tolerance_(tolerance), test_(tree, interior, tolerance) {}

  /// The cost of a triangle, or its limit.
  struct Cost {
    std::size_t steps = 0;   ///< in each of which one other is compared with one part
    std::size_t visits = 0;  ///< of nodes and triangles, to determine the sides of parts
  };
  struct Result {
    std::vector<SurfacePart> parts;  ///< that cover the triangle; none if the limit is too low
    Cost cost;
  };
  /// Cuts a triangle into parts. Neighbouring parts with the same sides are joined if one cut separates them.
  /// @param others  that cut it or lie on it, ascending.
  Result parts(int triangle, const std::vector<int>& others, const Cost& most) const;

 private:
  class Task;

  const TriangleMesh& mesh_;
  SurfaceTolerance tolerance_;
  SideTest test_;
};

}  // namespace sdf_ccd
