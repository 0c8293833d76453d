#pragma once

#include <vector>

#include "precision/exact_surface.h"
#include "precision/random_inputs.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/query/segment_query.h"

/// Where fields are hardest to get right.
namespace sdf_ccd::benchmark {

struct ExactPlace {
  Vector3d p;
  double distance;  ///< of the mesh [m]
};

/// `count` of each kind: anywhere in twice the mesh's box; near the surface; near edges and corners of triangles, from
/// 1e-9 of the side on; on the medial axis inside, where two places of the surface are nearest.
std::vector<ExactPlace> placesOfMesh(const precision::ExactSurface& mesh, std::size_t count, precision::Random& random);

/// `count` of each kind: on faces between cells and leaves, and a rounding error beside them; at the band's end.
std::vector<ExactPlace> placesOfField(const DistanceField& field, const precision::ExactSurface& mesh,
                                      std::size_t count, precision::Random& random);

/// `count` of each kind, all of whose starts are outside: both ends in the box, widened by a fifth; short ones from
/// near the surface; along tangents, at most a thousandth of the side beside the surface; through edges and corners.
std::vector<Segment> segmentsOfMesh(const precision::ExactSurface& mesh, std::size_t count, precision::Random& random);

/// Along faces between cells, in one of them.
std::vector<Segment> segmentsOfField(const DistanceField& field, const precision::ExactSurface& mesh, std::size_t count,
                                     precision::Random& random);

}  // namespace sdf_ccd::benchmark
