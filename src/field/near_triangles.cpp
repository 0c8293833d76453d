#include "near_triangles.h"

#include <algorithm>
#include <cmath>

#include "common/infinity.h"

namespace sdf_ccd {

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
      best = std::sqrt(tie2) * (1.0 + kDistanceRounding);
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
  if (exact.closed() && distance + std::abs(distance_) > (p - cube_.center).norm() * (1.0 + kDistanceRounding)) {
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

}  // namespace sdf_ccd
