#pragma once

#include <cstdint>

#include "sdf_ccd/geometry/primitive.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

class Solid;

struct ShellOptions {
  double spacing = 0.01;  ///< no location of the surface farther than this from a point [m]
  /// Where it is less than the spacing, edges get points of their own: of two surfaces that touch each other, sampled
  /// like this, a point of one is no farther than this from the other (see contact_gap.h) [m]. 0: no such points.
  double edge_gap = 0.0;
  bool has_siblings = false;  ///< the surface is one of several of a body, whose edges may be sampled apart
  /// Mesh vertices nearer than this to a kept vertex are left out [m]; 0 keeps all, but of a mesh whose parts overlap
  /// those nearer than a tenth of the spacing (or edge gap) are left out.
  double vertex_spacing = 0.0;
  std::uint64_t seed = 1;               ///< equal seeds give equal shells
  std::size_t max_points = 20'000'000;  ///< more are refused with std::length_error
};

/// Point shell of the boundary of a mesh's solid (see Solid; faces inside it get no points): its vertices (paper §5)
/// and a Poisson-disk sampling that fills the surface between them until no gap exceeds options.spacing. Vertex normals
/// are weighted by angle; a vertex of a sharp edge keeps its averaged normal. Areas sum to the boundary's area.
///
/// Faces need no points to be touched at: two polyhedra touch each other at an edge of one. So edges, but those within
/// flat pieces, can be sampled denser than faces (options.edge_gap), at a fraction of the points; where a
/// surface is so finely curved that its edges need more, all of it is.
///
/// A location belongs to the nearest point whose normal is not against the location's own, and gaps are filled by that
/// measure too, so both sides of a thin plate get points and area. The covering radius counts all points.
/// @throws std::invalid_argument if the mesh or the options are not valid.
PointShell sampleSurface(const TriangleMesh& mesh, const ShellOptions& options);
PointShell sampleSurface(const Solid& solid, const ShellOptions& options);

/// The points on vertices and edges alone, by options.edge_gap: no point represents an area, and the covering radius is
/// infinite. They show where the surface touches, not how hard.
/// @throws as sampleSurface(); std::invalid_argument also if the edge gap is 0.
PointShell sampleEdges(const TriangleMesh& mesh, const ShellOptions& options);

/// About how many points sampleSurface() would take, from the areas and edges alone; few vertices are assumed. Of many
/// slivers within the spacing of each other it is as many points as take their time. sampleSurface() refuses beforehand
/// what is expected to take more than options.max_points.
double expectedPoints(const TriangleMesh& mesh, const ShellOptions& options);

/// Point shell of a primitive: points exactly on its surface, with its exact normals away from edges. Areas sum to
/// the primitive's. Of a sphere or cylinder no two points that come from vertices are nearer than the spacing.
/// @throws std::invalid_argument for a half-space, which has no bounded surface.
PointShell sampleSurface(const Primitive& primitive, const ShellOptions& options);

}  // namespace sdf_ccd
