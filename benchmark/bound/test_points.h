#pragma once

#include <vector>

#include "precision/exact_surface.h"
#include "precision/random_inputs.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"

/// Test points and segments in the regions where fields are hardest to get right.
namespace sdf_ccd::benchmark {

struct ExactPoint {
  Vector3d p;
  double distance;  ///< signed, from the mesh [m]
};

/// `count` points of each kind: anywhere in twice the mesh's box; near the surface; near edges and vertices of
/// triangles, from 1e-9 of the side on; on the medial axis inside, where two points of the surface are nearest.
std::vector<ExactPoint> pointsOfMesh(const precision::ExactSurface& mesh, std::size_t count, precision::Random& random);

/// `count` points of each kind: on faces between cells or leaves and a rounding error beside them; at the band's edge.
std::vector<ExactPoint> pointsOfField(const DistanceField& field, const precision::ExactSurface& mesh,
                                      std::size_t count, precision::Random& random);

/// `count` segments of each kind, all starting outside: both ends in the box, enlarged by a fifth; short ones from near
/// the surface; parallel to the surface, at most a thousandth of the side from it; through edges and vertices.
std::vector<Segment> segmentsOfMesh(const precision::ExactSurface& mesh, std::size_t count, precision::Random& random);

/// `count` segments within a face between cells.
std::vector<Segment> segmentsOfField(const DistanceField& field, const precision::ExactSurface& mesh, std::size_t count,
                                     precision::Random& random);

}  // namespace sdf_ccd::benchmark
