#include "near_octants.h"

#include <algorithm>
#include <cmath>

#include "common/compiler_lanes.h"
#include "common/infinity.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

/// The maximum distance from a cube's centre to a triangle that is closest to a point in the cube: the point is at most
/// distance + radius from the surface, and at most another radius from the centre.
double reach(const SurfaceIndex& surface, const SpaceCube& cube, double distance) {
  return (std::abs(distance) + 2.0 * cube.radius()) * (1.0 + kDistanceRounding) + surface.exact().solid().seam();
}

/// Whether a triangle can be nearer to a point of a cube than another one, whose distances from the corners are given.
///
/// The distance from a triangle is convex. So it is nowhere below its tangent at the centre, and that from the other
/// triangle is nowhere above the interpolation of its values at the corners. If the tangent is above these values at
/// all corners, it is above the interpolation everywhere.
/// @param distance      from the triangle to the cube's centre, or a lower bound of it [m].
/// @param displacement  from the closest point (or the centre of a bounding sphere) to the cube's centre: the direction
///                      of the gradient.
/// @param length        of the displacement [m].
/// @param other         the other triangle's distances from the cube's corners [m].
SDF_CCD_INLINE bool mayBeNearest(double distance, const Vector3d& displacement, double length, double side,
                                 const PointLanes::Lane& other) {
  // All multiplied by the length, which avoids the division; a displacement of length zero proves nothing.
  const Vector3d slope = 0.5 * side * displacement;
  const Doubles across = {-slope.x() - slope.y(), slope.x() - slope.y(), slope.y() - slope.x(), slope.x() + slope.y()};
  const Doubles middle = distance * length + across;
  const Doubles above =
      smaller(middle - slope.z() - length * load(other.data()), middle + slope.z() - length * load(other.data() + 4));
  return !(leastOf(above) > 0.0);
}

/// Lists the triangles of `around` that may be closest to a point of an octant, without the one nearest to its centre.
/// Returns the list's end.
SDF_CCD_LANES std::int32_t* listNear(const NearTriangles& around, const DisplacementLanes* displacements, int octant,
                                     int nearest, double max_distance, const PointLanes::Lane& at_corners,
                                     std::int32_t* list) {
  const double side = 0.5 * around.cube().side, max_distance2 = max_distance * max_distance;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const double distance2 = displacements[i].distance2[octant];
    if (distance2 > max_distance2 || around.triangle(i) == nearest) continue;
    const double distance = std::sqrt(distance2);
    if (mayBeNearest(distance, displacements[i].at(octant), distance, side, at_corners)) *list++ = around.triangle(i);
  }
  return list;
}

/// Upper bounds of the distances from a cube's corners to a triangle, rounding included.
PointLanes::Lane distancesAtCorners(const SurfaceIndex& surface, int triangle, const SpaceCube& cube, double size) {
  PointLanes corners;
  for (int c = 0; c < 8; ++c) corners.set(c, cube.corner(c));
  ClosestLanes closest;
  closest.distance2.fill(kInfinity);
  surface.offer(triangle, Vector3d::Zero(), corners, closest);
  for (double& value : closest.distance2)
    value = std::sqrt(value) + kDistanceRounding * size + surface.exact().solid().seam();
  return closest.distance2;
}

}  // namespace

NearCube::NearCube(const SurfaceIndex& surface, const SpaceCube& cube, const SignedSurface::Nearest& nearest) {
  const double max_distance = reach(surface, cube, nearest.distance);
  const PointLanes::Lane at_corners = distancesAtCorners(surface, nearest.triangle, cube, max_distance);
  ids_.push_back(nearest.triangle);
  const auto may_matter = [&](const Vector3d& center, double radius) {
    const Vector3d displacement = cube.center - center;
    const double distance = displacement.norm();
    return distance - radius <= max_distance &&
           mayBeNearest(distance - radius, displacement, distance, cube.side, at_corners);
  };
  surface.exact().tree().forEachTriangle(may_matter, [&](int t) {
    if (t != nearest.triangle) ids_.push_back(t);
  });
  near_ = {surface, cube, nearest.distance, ids_.data(), ids_.size()};
}

NearOctants::NearOctants(const NearTriangles& around)
    : around_(around), displacements_(around.size()), ids_(around.size()) {
  DisplacementLanes* const displacements = displacements_.get();
  PointLanes centers;
  for (int k = 0; k < 8; ++k) centers.set(k, around_.cube().octant(k).center);
  PointLanes::Lane best2;
  best2.fill(kInfinity);
  std::array<std::size_t, 8> best{};
  for (std::size_t i = 0; i < around_.size(); ++i) {
    around_.surface().displacements(around_.triangle(i), centers, displacements[i]);
    for (int k = 0; k < 8; ++k) {
      if (displacements[i].distance2[k] < best2[k]) {
        best2[k] = displacements[i].distance2[k];
        best[k] = i;
      }
    }
  }
  for (int k = 0; k < 8; ++k) {
    nearest_[k] = around_.triangle(best[k]);
    distances_[k] = sign(k, best[k]) * std::sqrt(best2[k]);
  }
}

int NearOctants::sign(int k, std::size_t nearest) const {
  const DisplacementLanes* const displacements = displacements_.get();
  const auto sideOf = [](double along) { return along < 0.0 ? -1 : 1; };
  const DirectionCone& cone = around_.gradientCone();
  if (cone.sine < 1.0) return sideOf(displacements[nearest].at(k).dot(cone.axis));
  // As in NearTriangles::signedDistance().
  const double best2 = displacements[nearest].distance2[k], tie2 = around_.surface().tie2(best2);
  int agreed = 0;
  bool agree = true;
  for (std::size_t i = 0; i < around_.size() && agree; ++i) {
    if (displacements[i].distance2[k] > tie2) continue;
    const SurfaceIndex::Face& face = around_.surface().face(around_.triangle(i));
    const int side = face.separates ? sideOf(displacements[i].at(k).dot(face.normal)) : 0;
    agree = side != 0 && (agreed == 0 || side == agreed);
    agreed = side;
  }
  return agree ? agreed : around_.signFarther(around_.cube().octant(k).center, std::sqrt(best2));
}

const NearTriangles& NearOctants::operator[](int k) {
  NearTriangles& near = near_[k];
  if (near.size() > 0) return near;
  std::int32_t* const first = ids_.get() + k * around_.size();
  *first = nearest_[k];
  const SpaceCube octant = around_.cube().octant(k);
  const double max_distance = reach(around_.surface(), octant, distances_[k]);
  const PointLanes::Lane at_corners = distancesAtCorners(around_.surface(), nearest_[k], octant, max_distance);
  const std::int32_t* const last =
      listNear(around_, displacements_.get(), k, nearest_[k], max_distance, at_corners, first + 1);
  near = {around_.surface(), octant, distances_[k], first, static_cast<std::size_t>(last - first)};
  return near;
}

}  // namespace sdf_ccd
