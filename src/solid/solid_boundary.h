#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "solid/interior.h"

namespace sdf_ccd {

/// What was found when a mesh was reduced to the boundary of its solid.
struct SolidReport {
  std::size_t pairs = 0;     ///< of triangles that cut or overlap each other, or touch elsewhere than at common edges
  int dropped = 0;           ///< triangles that lie inside the solid
  int clipped = 0;           ///< triangles of which a part lies inside the solid, which is left out
  int pieces = 0;            ///< triangles into which the rest of those was cut
  int reversed = 0;          ///< triangles, or pieces, that were inside out
  int doubtful = 0;          ///< triangles that may lie inside in part: their sides are not certain everywhere
  double doubtful_area = 0;  ///< where the sides are not certain, relative to the mesh's area
  /// Upper bound of the distance from there to the triangles that certainly bound the solid [m]: so depths are too
  /// small by no more, even if all of it lies inside. Infinite if that is not small.
  double doubtful_reach = 0;
  std::string failure;  ///< why all triangles were taken as they are; empty if that was not necessary
};

/// One line of text: "12 triangles inside the solid removed, 4 triangles clipped into 9"; empty if there is nothing to
/// say.
std::string summary(const SolidReport& report);

/// A warning for users: where depths may be those of faces inside the solid. Empty if nowhere.
std::string warning(const SolidReport& report);

/// Limits of the cost of reducing a mesh. With more pairs, all triangles are kept as they are; with more steps or
/// visits, those whose parts are not known by then.
struct SolidLimits {
  std::size_t pairs = 3'000'000;     ///< that cut each other
  std::size_t steps = 60'000'000;    ///< in each of which a triangle is compared with a piece of another
  std::size_t visits = 400'000'000;  ///< of nodes and triangles, to determine the sides of pieces
};

/// A mesh as the solid that it bounds, if it is closed (see Interior): all points where the winding number of a part is
/// not zero, except cavities. Overlapping parts are one solid, and a part that is inside out is solid, too.
///
/// Triangles inside the solid are left out. Those that lie inside in part are cut, and the inner parts left out: only
/// parts with the inside certainly both before and behind them. So no point of the solid's boundary is farther from the
/// kept triangles than the width of a strip along cuts, 1e-9 of the mesh's size. Faces nearer to each other than 1e-10
/// of that size are taken as one: such a gap between two parts is closed. Faces with the outside on both sides (a wall
/// without thickness, drawn from both sides) are kept.
///
/// If the mesh is not closed there is no solid: all triangles are kept.
class Solid {
 public:
  /// @throws std::invalid_argument if the mesh is not valid (see validate()).
  explicit Solid(const TriangleMesh& mesh, const SolidLimits& limits = {});

  bool closed() const { return interior_.closed(); }
  const SolidReport& report() const { return report_; }

  /// The triangles that are kept, oriented outward.
  const TriangleMesh& boundary() const { return boundary_; }
  const TriangleTree& tree() const { return *tree_; }  ///< over the boundary

  /// Per triangle of the boundary, 1 if its front certainly faces the outside and its back the inside: both were
  /// queried, and nothing cuts or overlaps the triangle, within 1e-10 of the mesh's size, conservatively. Where only
  /// such triangles are near, the gradient of the signed distance lies in the convex cone of their normals. All 0 for a
  /// mesh that is not closed.
  ///
  /// Pieces of cut triangles do not share edges or corners with their neighbours. The cone of normals does not require
  /// that: it is enough that a line out of the solid passes through a triangle that faces in the line's direction.
  /// Pieces that meet in an edge must be considered together: see seam().
  const std::vector<std::uint8_t>& separates() const { return separates_; }

  /// Upper bound of the gap between pieces that meet [m]: triangles whose distance exceeds that of the closest one by
  /// less may be as close. 0 if nothing was cut.
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
