#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cut_lists.h"
#include "solid/interior.h"

namespace sdf_ccd {

/// What lies before and behind a flat piece of a closed mesh's surface.
enum class Sides : std::uint8_t {
  kUnknown,    ///< not certain
  kOutward,    ///< outside before it, inside behind it
  kInward,     ///< the reverse: of a part that is inside out
  kInterior,   ///< inside on both sides
  kDuplicate,  ///< lies on another triangle, which stands for both
  kSheet,      ///< outside on both sides: two faces that lie on each other
};

/// Determines the sides of flat pieces of a closed mesh.
class SideTest {
 public:
  /// @param tree, interior  of the same mesh.
  SideTest(const TriangleTree& tree, const Interior& interior, const SurfaceTolerance& tolerance)
      : tree_(tree), interior_(interior), tolerance_(tolerance) {}

  /// A point of a piece.
  struct PiecePoint {
    Vector3d point;
    Vector3d normal;   ///< of length one
    double clearance;  ///< least distance to the piece's border [m]
    int triangle;      ///< the triangle of which it is a piece
  };

  /// Sides of a piece at one of its points. Nothing but its layers may touch the piece: then the sides are the same
  /// everywhere on it. The two query points, before and behind the piece, are nearer to the point than to any other
  /// triangle.
  /// @param layers   triangles (ascending) that lie on all of the piece, and are taken as one with it.
  /// @param visited  if given, the number of visited nodes and triangles is added to it.
  Sides at(const PiecePoint& piece, const std::vector<int>& layers, std::size_t* visited = nullptr) const;

 private:
  const TriangleTree& tree_;
  const Interior& interior_;
  SurfaceTolerance tolerance_;
};

/// Sides of the triangles of a closed mesh that nothing cuts; kUnknown for the others.
///
/// If two triangles share an edge with no third one, and nothing cuts them, nothing lies between them just before the
/// surface, so the winding number is the same there. One triangle therefore decides for a connected set.
std::vector<Sides> sidesOfUncut(const TriangleMesh& mesh, const TriangleTree& tree, const Interior& interior,
                                const CutLists& cuts, const SurfaceTolerance& tolerance);

}  // namespace sdf_ccd
