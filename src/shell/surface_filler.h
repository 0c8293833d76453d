#pragma once

#include <cstdint>
#include <vector>

#include "common/cancel_point.h"
#include "flat_pieces.h"
#include "point_grid.h"
#include "sample_surface.h"
#include "sampled_points.h"
#include "sdf_ccd/mesh.h"
#include "surface_piece.h"

namespace sdf_ccd {

/// Adds points to a shell until no location of the mesh is farther than options.spacing from a point whose normal does
/// not oppose the location's, or throws Cancelled on request.
class SurfaceFiller {
 public:
  /// @param mesh  welded.
  SurfaceFiller(const TriangleMesh& mesh, const ShellOptions& options);

  /// The mesh's vertices, thinned to options.vertex_spacing.
  void addVertices();
  /// Points along edges, until no location of one is farther than `radius` from a point [m].
  void fillEdges(const std::vector<SurfaceEdge>& edges, double radius);
  /// Poisson-disk sampling: random locations, kept if no point with a compatible normal is nearer than the spacing.
  void throwDarts();
  /// Halves triangles until one point covers each piece; adds a point wherever none does.
  void fillGaps();

  SampledPoints moveOut() { return std::move(shell_); }

 private:
  [[noreturn]] void refuse() const;
  void add(const Vector3d& p, const Vector3d& normal);
  bool isCovered(const Vector3d& p, const Vector3d& normal) const;
  void fillGaps(const SurfacePiece& whole, const Vector3d& normal);

  /// A piece that is still to be filled, and the points that may cover parts of it: a range of `candidates_`, and all
  /// points from the `known`-th on. The range is empty if none have been gathered yet.
  struct OpenPiece {
    SurfacePiece piece;
    std::size_t begin, end, known;
  };
  /// Appends a piece's candidates to `candidates_`.
  void gather(OpenPiece& open, const Vector3d& center, const Vector3d& normal);

  const CancelPoint cancel_;
  const TriangleMesh& mesh_;
  const ShellOptions& options_;
  std::vector<Vector3d> triangle_normals_;  // unit, or zero
  PointGrid grid_;
  SampledPoints shell_;
  std::vector<OpenPiece> pieces_;  // of the current triangle
  std::vector<Vector3d> candidates_;
};

}  // namespace sdf_ccd
