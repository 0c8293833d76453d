#pragma once

#include <cstdint>

#include "sdf_ccd/field.h"
#include "sdf_ccd/primitive.h"
#include "shell/point_shell.h"

namespace sdf_ccd {

class Solid;

/// Point shell of the boundary of a mesh's solid (see Solid; faces inside it get no points): its vertices (paper §5)
/// and a Poisson-disk sampling that fills the surface between them until no gap exceeds options.spacing. Vertex normals
/// are weighted by angle; a vertex of a sharp edge keeps its averaged normal. Areas sum to the boundary's area.
///
/// Two polyhedra first touch at an edge of one of them, so contacts are found by points on edges, not faces. Edges,
/// except those within flat pieces, can therefore be sampled more densely than faces (options.edge_gap), at a fraction
/// of the points; where a surface is so finely curved that its edges would need more points than the surface, all of it
/// is sampled more densely.
///
/// A location belongs to the nearest point whose normal does not oppose the location's own, and gaps are filled by the
/// same measure, so both sides of a thin plate get points and area. The covering radius counts all points.
/// @throws std::invalid_argument if the mesh or the options are not valid; std::length_error beyond options.max_points,
/// at once if areas and edges show it.
PointShell sampleSurface(const TriangleMesh& mesh, const ShellOptions& options);
PointShell sampleSurface(const Solid& solid, const ShellOptions& options);

/// Point shell of a primitive: points exactly on its surface, with its exact normals away from edges. Areas sum to the
/// primitive's. On a sphere or cylinder, points from vertices are no nearer to each other than the spacing.
/// @throws std::invalid_argument for a half-space, which has no bounded surface.
PointShell sampleSurface(const Primitive& primitive, const ShellOptions& options);

}  // namespace sdf_ccd
