#include "near_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sdf_ccd/geometry/separating_triangles.h"

namespace sdf_ccd {
namespace {

/// What rounding may take from a distance, relative to the ball it is compared in.
constexpr double kSlack = 1e-9;

double distanceTo(const SurfaceIndex::Triangle& t, const Vector3d& p) {
  return (t.shape.closest(p) - p).norm();
}

/// How far a triangle may be from the centre of a ball and still be the closest to a place in it: that place is within
/// distance + radius of the surface, and the centre within another radius of it.
double reach(const Ball& ball, double distance) {
  return (std::abs(distance) + 2.0 * ball.radius) * (1.0 + kSlack);
}

}  // namespace

SurfaceIndex::SurfaceIndex(const TriangleMesh& mesh) : exact_(mesh) {
  const std::vector<std::uint8_t> separates = separatingTriangles(mesh, exact_.tree());
  triangles_.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    const MeasuredTriangle shape(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    triangles_.push_back({shape, areaNormal(mesh, static_cast<int>(i)).normalized(), separates[i] != 0});
  }
}

NearTriangles::NearTriangles(const SurfaceIndex& surface, const Ball& ball, double distance)
    : surface_(surface), ball_(ball), distance_(distance) {
  thread_local std::vector<int> found;
  surface.exact().tree().trianglesWithin(ball.center, reach(ball, distance), found);
  entries_.reserve(found.size());
  for (const int i : found) entries_.push_back({distanceTo(surface.triangle(i), ball.center), i});
  sortAndSetCone();
}

NearTriangles::NearTriangles(const NearTriangles& around, const Ball& ball, double distance)
    : surface_(around.surface_), ball_(ball), distance_(distance) {
  const double most = reach(ball, distance);
  const double apart = (ball.center - around.ball_.center).norm();
  for (const Entry& entry : around.entries_) {
    if (entry.distance - apart > most) break;
    const SurfaceIndex::Triangle& t = surface_.triangle(entry.triangle);
    if (!t.shape.mayBeWithin(most, ball.center)) continue;
    const double d = distanceTo(t, ball.center);
    if (d <= most) entries_.push_back({d, entry.triangle});
  }
  sortAndSetCone();
}

void NearTriangles::sortAndSetCone() {
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
  });
  cone_ = coneOf(entries_);
}

DirectionCone NearTriangles::coneOf(const std::vector<Entry>& entries) const {
  DirectionCone cone;
  for (const Entry& entry : entries) {
    const SurfaceIndex::Triangle& t = surface_.triangle(entry.triangle);
    if (!t.separates) return {};
    cone.axis += t.normal;
  }
  const double length = cone.axis.norm();
  if (!(length > 0.0)) return {};
  cone.axis /= length;
  double cosine = 1.0, sine = 0.0;
  for (const Entry& entry : entries) {
    const Vector3d& normal = surface_.triangle(entry.triangle).normal;
    cosine = std::min(cosine, normal.dot(cone.axis));
    sine = std::max(sine, normal.cross(cone.axis).squaredNorm());
  }
  if (cosine < 0.1) return {};
  cone.sine = std::min(1.0, std::sqrt(sine) * (1.0 + kSlack));
  return cone;
}

NearTriangles::Closest NearTriangles::closest(const Vector3d& p) const {
  // Triangles that share the closest edge or vertex tie, to rounding.
  constexpr double kTie = 1e-12;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double best2 = kInfinity, best = kInfinity;
  Closest closest{kInfinity, p, 0};
  const double apart = (p - ball_.center).norm();
  for (const Entry& entry : entries_) {
    if (entry.distance - apart > best) break;
    const SurfaceIndex::Triangle& t = surface_.triangle(entry.triangle);
    if (!t.shape.mayBeWithin(best, p)) continue;
    const Vector3d q = t.shape.closest(p);
    const double distance2 = (q - p).squaredNorm();
    if (distance2 > best2 * (1.0 + kTie)) continue;
    const int sign = !t.separates ? 0 : (p - q).dot(t.normal) < 0.0 ? -1 : 1;
    const bool tie = distance2 >= best2 * (1.0 - kTie);
    closest.sign = tie && sign != closest.sign ? 0 : sign;
    if (distance2 < best2) {
      best2 = distance2;
      best = std::sqrt(distance2) * (1.0 + kTie);
      closest.point = q;
    }
  }
  closest.distance = std::sqrt(best2);
  return closest;
}

double NearTriangles::signedDistance(const Vector3d& p) const {
  const Closest found = closest(p);
  const double d = found.distance;
  // Where all gradients lie in one cone, the way to the closest point does too. Else: outside, the way from the closest
  // point is a positive sum of the normals of the triangles that share it, so one at least agrees with it; inside, a
  // negative one. If all agree, that is the sign.
  if (cone_.sine < 1.0) return (p - found.point).dot(cone_.axis) < 0.0 ? -d : d;
  if (found.sign != 0) return found.sign * d;
  // The balls without surface about p and the centre meet.
  if (surface_.exact().closed() && d + std::abs(distance_) > (p - ball_.center).norm() * (1.0 + kSlack)) {
    return distance_ < 0.0 ? -d : d;
  }
  return surface_.exact().inside(p) ? -d : d;
}

DirectionCone NearTriangles::gradientCone(const Ball& ball) const {
  const double most = reach(ball, closest(ball.center).distance);
  const double apart = (ball.center - ball_.center).norm();
  thread_local std::vector<Entry> found;
  found.clear();
  for (const Entry& entry : entries_) {
    if (entry.distance - apart > most) break;
    const SurfaceIndex::Triangle& t = surface_.triangle(entry.triangle);
    if (!t.shape.mayBeWithin(most, ball.center)) continue;
    if (distanceTo(t, ball.center) <= most) found.push_back(entry);
  }
  return coneOf(found);
}

}  // namespace sdf_ccd
