#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/interior.h"
#include "triangle_cuts.h"

namespace sdf_ccd {

/// What lies before and behind a piece of a closed mesh's surface.
enum class Sides : std::uint8_t {
  kUnknown,  ///< not certain
  kOutward,  ///< outside before it, inside behind it
  kInward,   ///< the reverse: of a part that is inside out
  kBuried,   ///< inside on both sides
  kCovered,  ///< as another triangle that lies on it, which stands for both
  kSheet,    ///< outside on both sides: two faces that lie on each other
};

/// Tells the sides of flat pieces of a closed mesh.
class SideTest {
 public:
  /// @param tree, interior  of the same mesh.
  SideTest(const TriangleTree& tree, const Interior& interior, const SurfaceTolerance& tolerance)
      : tree_(tree), interior_(interior), tolerance_(tolerance) {}

  /// A place of a piece. Those of `layers` (ascending) lie on all of the piece and are taken together with it.
  struct Place {
    Vector3d point;
    Vector3d normal;   ///< of length one
    double clearance;  ///< least distance of the piece's border [m]
    int triangle;      ///< that the piece is of
  };

  /// Sides at a place of a piece that nothing but its layers touches: they are the same all over the piece. Both points
  /// at which inside and outside are asked for are nearer to the place than to any other triangle.
  /// @param visited  if given, the number of nodes and triangles that were looked at is added to it.
  Sides at(const Place& place, const std::vector<int>& layers, std::size_t* visited = nullptr) const;

 private:
  const TriangleTree& tree_;
  const Interior& interior_;
  SurfaceTolerance tolerance_;
};

/// For the triangles of a closed mesh that nothing cuts their sides; kUnknown for the others.
///
/// Just before the surface nothing lies between triangles that share an edge with no third one and that nothing cuts:
/// the winding number is the same there. So one of a connected set speaks for all.
std::vector<Sides> sidesOfUncut(const TriangleMesh& mesh, const TriangleTree& tree, const Interior& interior,
                                const TriangleCuts& cuts, const SurfaceTolerance& tolerance);

}  // namespace sdf_ccd
