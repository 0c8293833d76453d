#include "near_triangles.h"

#include <algorithm>
#include <cmath>

#include "common/compiler_lanes.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Upper bound of a distance's rounding, relative to the cube it is compared in.
constexpr double kSlack = 1e-9;

/// The maximum distance from a cube's centre to a triangle that is closest to a point in the cube: the point is at most
/// distance + radius from the surface, and at most another radius from the centre.
double reach(const SurfaceIndex& surface, const SpaceCube& cube, double distance) {
  return (std::abs(distance) + 2.0 * cube.radius()) * (1.0 + kSlack) + surface.exact().solid().seam();
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
SDF_CCD_LANES std::int32_t* listNear(const NearTriangles& around, const DisplacementLanes* ways, int octant,
                                     int nearest, double max_distance, const PointLanes::Lane& at_corners,
                                     std::int32_t* list) {
  const double side = 0.5 * around.cube().side, max_distance2 = max_distance * max_distance;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const double distance2 = ways[i].distance2[octant];
    if (distance2 > max_distance2 || around.triangle(i) == nearest) continue;
    const double distance = std::sqrt(distance2);
    if (mayBeNearest(distance, ways[i].at(octant), distance, side, at_corners)) *list++ = around.triangle(i);
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
  for (double& value : closest.distance2) value = std::sqrt(value) + kSlack * size + surface.exact().solid().seam();
  return closest.distance2;
}

}  // namespace

SurfaceIndex::SurfaceIndex(Solid solid) : exact_(std::move(solid)) {
  const TriangleMesh& mesh = exact_.solid().boundary();
  const std::vector<std::uint8_t>& separates = exact_.solid().separates();
  triangles_.reserve(mesh.triangles.size());
  faces_.reserve(mesh.triangles.size());
  flat_.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    triangles_.emplace_back(a, b, c);
    faces_.push_back(
        {areaNormal(mesh, static_cast<int>(i)).normalized(), separates[i] != 0, triangles_.back().sliver()});
    flat_.emplace_back(a, b, c);
  }
}

void SurfaceIndex::offer(int i, const Vector3d& axis, const PointLanes& points, ClosestLanes& closest) const {
  if (!face(i).sliver) return sdf_ccd::offer(flat_[static_cast<std::size_t>(i)], axis, points, closest);
  for (int k = 0; k < PointLanes::kCount; ++k) {
    const Vector3d p = points.at(k), displacement = p - triangle(i).closest(p);
    if (displacement.squaredNorm() >= closest.distance2[k]) continue;
    closest.distance2[k] = displacement.squaredNorm();
    closest.side[k] = displacement.dot(axis);
  }
}

void SurfaceIndex::ways(int i, const PointLanes& points, DisplacementLanes& ways) const {
  if (!face(i).sliver) return sdf_ccd::ways(flat_[static_cast<std::size_t>(i)], points, ways);
  for (int k = 0; k < PointLanes::kCount; ++k) {
    const Vector3d p = points.at(k), displacement = p - triangle(i).closest(p);
    ways.distance2[k] = displacement.squaredNorm();
    ways.x[k] = displacement.x();
    ways.y[k] = displacement.y();
    ways.z[k] = displacement.z();
  }
}

NearTriangles::NearTriangles(const SurfaceIndex& surface, const SpaceCube& cube, double distance,
                             const std::int32_t* ids, std::size_t count)
    : surface_(&surface), cube_(cube), distance_(distance), ids_(ids), count_(count) {
  setCone();
}

void NearTriangles::setCone() {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    const SurfaceIndex::Face& face = surface_->face(ids_[i]);
    if (!face.separates) return;
    sum += face.normal;
  }
  const Vector3d* farthest = setCone(sum);
  constexpr double kNarrow = 1e-6;
  if (count_ < 3 || cone_.sine < kNarrow) return;
  // If most normals lie on one side, the middle of the two that are farthest apart is a better axis than the mean.
  const Vector3d& first = *farthest;
  const Vector3d* second = &first;
  for (std::size_t i = 0; i < count_; ++i) {
    const Vector3d& normal = surface_->face(ids_[i]).normal;
    if (normal.dot(first) < second->dot(first)) second = &normal;
  }
  setCone(first + *second);
}

/// Takes the axis if that makes the cone narrower. Returns the normal farthest from it.
const Vector3d* NearTriangles::setCone(Vector3d axis) {
  const Vector3d* farthest = &surface_->face(ids_[0]).normal;
  const double length = axis.norm();
  if (!(length > 0.0)) return farthest;
  axis /= length;
  double cosine = 1.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Vector3d& normal = surface_->face(ids_[i]).normal;
    const double along = normal.dot(axis);
    farthest = along < cosine ? &normal : farthest;
    cosine = std::min(cosine, along);
  }
  constexpr double kRounding = 1e-15;
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0) + kRounding);
  if (cosine >= 0.1 && sine < cone_.sine) cone_ = {axis, sine};
  return farthest;
}

NearTriangles::Closest NearTriangles::closest(const Vector3d& p) const {
  double best2 = kInfinity, tie2 = kInfinity, best = kInfinity;
  Closest closest{kInfinity, p, 0};
  for (std::size_t i = 0; i < count_; ++i) {
    const MeasuredTriangle& t = surface_->triangle(ids_[i]);
    if (!t.mayBeWithin(best, p)) continue;
    const Vector3d q = t.closest(p);
    const double distance2 = (q - p).squaredNorm();
    if (distance2 > tie2) continue;
    const SurfaceIndex::Face& face = surface_->face(ids_[i]);
    const int sign = !face.separates ? 0 : (p - q).dot(face.normal) < 0.0 ? -1 : 1;
    const bool tie = surface_->tie2(distance2) >= best2;
    closest.sign = tie && sign != closest.sign ? 0 : sign;
    if (distance2 < best2) {
      best2 = distance2;
      tie2 = surface_->tie2(distance2);
      best = std::sqrt(tie2) * (1.0 + kSlack);
      closest.point = q;
    }
  }
  closest.distance = std::sqrt(best2);
  return closest;
}

double NearTriangles::signedDistance(const Vector3d& p) const {
  const Closest found = closest(p);
  const double d = found.distance;
  // If all gradients lie in one cone, its axis tells the side of the closest point on which p is. Otherwise: outside,
  // the vector from the closest point to p is a positive combination of the normals of the triangles that share this
  // point, so p is in front of at least one; inside, a negative one. If all triangles agree, their sign is right.
  if (cone_.sine < 1.0) return (p - found.point).dot(cone_.axis) < 0.0 ? -d : d;
  return (found.sign != 0 ? found.sign : signFarther(p, d)) * d;
}

int NearTriangles::signFarther(const Vector3d& p, double distance) const {
  // The empty spheres about p and the centre intersect.
  const SignedSurface& exact = surface_->exact();
  if (exact.closed() && distance + std::abs(distance_) > (p - cube_.center).norm() * (1.0 + kSlack)) {
    return distance_ < 0.0 ? -1 : 1;
  }
  return exact.inside(p) ? -1 : 1;
}

void NearTriangles::signedDistances(const PointLanes& points, int count, PointLanes::Lane& distances) const {
  if (!(cone_.sine < 1.0)) {
    for (int k = 0; k < count; ++k) distances[k] = signedDistance(points.at(k));
    return;
  }
  ClosestLanes closest;
  closest.distance2.fill(kInfinity);
  for (std::size_t i = 0; i < count_; ++i) surface_->offer(ids_[i], cone_.axis, points, closest);
  for (int k = 0; k < PointLanes::kCount; ++k) {
    const double d = std::sqrt(closest.distance2[k]);
    distances[k] = closest.side[k] < 0.0 ? -d : d;
  }
}

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

NearOctants::NearOctants(const NearTriangles& around) : around_(around), ways_(around.size()), ids_(around.size()) {
  DisplacementLanes* const ways = ways_.get();
  PointLanes centers;
  for (int k = 0; k < 8; ++k) centers.set(k, around_.cube().octant(k).center);
  PointLanes::Lane best2;
  best2.fill(kInfinity);
  std::array<std::size_t, 8> best{};
  for (std::size_t i = 0; i < around_.size(); ++i) {
    around_.surface().ways(around_.triangle(i), centers, ways[i]);
    for (int k = 0; k < 8; ++k) {
      if (ways[i].distance2[k] < best2[k]) {
        best2[k] = ways[i].distance2[k];
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
  const DisplacementLanes* const ways = ways_.get();
  const auto sideOf = [](double along) { return along < 0.0 ? -1 : 1; };
  const DirectionCone& cone = around_.gradientCone();
  if (cone.sine < 1.0) return sideOf(ways[nearest].at(k).dot(cone.axis));
  // As in NearTriangles::signedDistance().
  const double best2 = ways[nearest].distance2[k], tie2 = around_.surface().tie2(best2);
  int agreed = 0;
  bool agree = true;
  for (std::size_t i = 0; i < around_.size() && agree; ++i) {
    if (ways[i].distance2[k] > tie2) continue;
    const SurfaceIndex::Face& face = around_.surface().face(around_.triangle(i));
    const int side = face.separates ? sideOf(ways[i].at(k).dot(face.normal)) : 0;
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
  const std::int32_t* const last = listNear(around_, ways_.get(), k, nearest_[k], max_distance, at_corners, first + 1);
  near = {around_.surface(), octant, distances_[k], first, static_cast<std::size_t>(last - first)};
  return near;
}

}  // namespace sdf_ccd
