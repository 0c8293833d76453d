#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geometry/interior.h"

namespace sdf_ccd {

/// What was found when a mesh was reduced to the boundary of its solid.
struct SolidReport {
  std::size_t pairs = 0;     ///< of triangles that cut or overlap each other, or touch beside their common edges
  int dropped = 0;           ///< triangles that lie inside the solid
  int clipped = 0;           ///< triangles of which a part does, which is left out
  int pieces = 0;            ///< triangles that what is left of those was cut into
  int reversed = 0;          ///< triangles, or pieces, that were inside out
  int doubtful = 0;          ///< triangles that may lie inside in part: their sides are not certain all over
  double doubtful_area = 0;  ///< where the sides are not certain, over the mesh's
  std::string failure;       ///< why all triangles were taken as they are; empty if that was not necessary
};

/// One line for people: "12 triangles inside left out, 4 clipped into 9"; empty if there is nothing to say.
std::string summary(const SolidReport& report);

/// What a user must know: where depths may be those of faces inside the solid. Empty if nowhere.
std::string warning(const SolidReport& report);

/// What reducing a mesh may cost: beyond that all its triangles are taken.
struct SolidLimits {
  std::size_t pairs = 3'000'000;       ///< that cut each other
  std::size_t steps = 60'000'000;      ///< in each of which a triangle is compared with a piece of another
  std::size_t visits = 400'000'000;  ///< of nodes and triangles to tell pieces' sides
};

/// A mesh as the solid that it bounds, if it is closed (see Interior): all places where the winding number of a part is
/// not zero, but for cavities. Overlapping parts are one solid, and a part that is inside out is solid too.
///
/// Triangles that lie inside the solid are left out. Those of which a part does are cut, and these parts left out: only
/// what is certain to be inside before and behind the surface. So no place of the solid's boundary is farther from
/// what is kept than a strip along cuts is wide, 1e-9 of the mesh's size. Faces nearer to each other than 1e-10 of that
/// size are taken as one: such a gap between two parts is closed. Faces with outside on both sides (a wall without
/// thickness, drawn from both sides) stay.
///
/// Where the mesh is not closed there is no solid: all triangles are kept.
class Solid {
 public:
  /// @throws std::invalid_argument if the mesh is not valid (see validate()).
  explicit Solid(const TriangleMesh& mesh, const SolidLimits& limits = {});

  bool closed() const { return interior_.closed(); }
  const SolidReport& report() const { return report_; }

  /// What is kept, turned outward.
  const TriangleMesh& boundary() const { return boundary_; }
  const TriangleTree& tree() const { return *tree_; }  ///< over it

  /// For each of the boundary's triangles 1 if it is certain that its front faces the outside and its back the inside:
  /// both have been asked for, and nothing cuts or overlaps it, within 1e-10 of the mesh's size and on the cautious
  /// side. Where only such triangles are near, the gradient of the signed distance lies in the convex cone of their
  /// normals. None of a mesh that is not closed.
  ///
  /// What was cut off lies beside its neighbours without
  /// sharing edges or corners with them, which the cone of normals does not need: that a line out of the solid passes
  /// through a triangle that faces its way is enough. Pieces that meet in an edge must be asked together: see seam().
  const std::vector<std::uint8_t>& separates() const { return separates_; }

  /// How far pieces that meet may be apart [m]: what is nearer than that to the closest one may be as close. 0 where
  /// nothing was cut.
  double seam() const { return seam_; }

  bool inside(const Vector3d& p) const { return interior_.contains(p); }

 private:
  std::shared_ptr<const TriangleTree> tree_;
  Interior interior_;  ///< of all triangles
  TriangleMesh boundary_;
  std::vector<std::uint8_t> separates_;
  double seam_ = 0.0;
  SolidReport report_;
};

}  // namespace sdf_ccd
