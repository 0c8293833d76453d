#include "triangle_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

void offer(const Vector3d& on_a, const Vector3d& on_b, ClosestPair& best) {
  const double distance2 = (on_b - on_a).squaredNorm();
  if (distance2 < best.distance2) best = {on_a, on_b, distance2};
}

double clamped(double x) {
  return std::min(std::max(x, 0.0), 1.0);
}

/// Offers the closest points of an edge of A and an edge of B.
void offerEdges(const Vector3d& a, const Vector3d& u, const Vector3d& b, const Vector3d& v, ClosestPair& best) {
  const Vector3d w = a - b;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 0.0 ? clamped((uv * vw - vv * uw) / determinant) : 0.0;
  const double t = vv > 0.0 ? clamped((uv * s + vw) / vv) : 0.0;
  if (uu > 0.0) s = clamped((uv * t - uw) / uu);
  offer(a + s * u, b + t * v, best);
}

/// The foot of the perpendicular from p, if it lies within the triangle.
std::optional<Vector3d> footOn(const Corners& t, const Vector3d& p) {
  const Vector3d ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  if (!(area2 > 0.0)) return std::nullopt;
  const double v = ap.cross(ac).dot(normal) / area2, w = ab.cross(ap).dot(normal) / area2;
  if (!(v >= 0.0 && w >= 0.0 && v + w <= 1.0)) return std::nullopt;
  return t[0] + v * ab + w * ac;
}

/// The corner at which the two shorter edges meet: of a narrow triangle they tell the normal best.
int acrossLongestEdge(const Corners& t) {
  const double a = (t[2] - t[1]).squaredNorm(), b = (t[0] - t[2]).squaredNorm(), c = (t[1] - t[0]).squaredNorm();
  return a >= b ? (a >= c ? 0 : 2) : (b >= c ? 1 : 2);
}

constexpr double kTilt = 8.0 * std::numeric_limits<double>::epsilon();  // see piercedPoint()

}  // namespace

ClosestPair closestPoints(const Corners& a, const Corners& b) {
  ClosestPair best{a[0], b[0], (b[0] - a[0]).squaredNorm()};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) offerEdges(a[i], a[(i + 1) % 3] - a[i], b[k], b[(k + 1) % 3] - b[k], best);
  for (int i = 0; i < 3; ++i) {
    if (const auto foot = footOn(b, a[i])) offer(a[i], *foot, best);
    if (const auto foot = footOn(a, b[i])) offer(*foot, b[i], best);
  }
  return best;
}

double gapAlong(const Vector3d& axis, const Corners& a, const Corners& b) {
  const double length = axis.norm();
  if (!(length > 0.0)) return -kInfinity;
  const Vector3d n = axis / length;
  return std::min({n.dot(b[0]), n.dot(b[1]), n.dot(b[2])}) - std::max({n.dot(a[0]), n.dot(a[1]), n.dot(a[2])});
}

std::optional<Vector3d> piercedPoint(const Corners& t, const Vector3d& p, const Vector3d& q, double error) {
  const int first = acrossLongestEdge(t);
  const Vector3d &from = t[first], u = t[(first + 1) % 3] - from, v = t[(first + 2) % 3] - from, cross = u.cross(v);
  const double area2 = cross.norm();
  if (!(area2 > 0.0)) return std::nullopt;
  const double farthest = std::max({u.norm(), v.norm(), (p - from).norm(), (q - from).norm()});
  error += 2.0 * kTilt * u.norm() * v.norm() / area2 * farthest;
  const Vector3d normal = cross / area2;
  const double at_p = normal.dot(p - from), at_q = normal.dot(q - from);
  if (!(at_p * at_q < 0.0) || !(std::min(std::abs(at_p), std::abs(at_q)) > error)) return std::nullopt;
  const double across = std::abs(at_p - at_q);
  const Vector3d point = p + std::abs(at_p) / across * (q - p);
  const double margin = error * (1.0 + (q - p).norm() / across);
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = t[(k + 1) % 3] - t[k];
    if (!(normal.cross(side).dot(point - t[k]) > margin * side.norm())) return std::nullopt;
  }
  return point;
}

std::optional<Vector3d> crossingPoint(const Corners& a, const Corners& b, double error) {
  for (int k = 0; k < 3; ++k) {
    if (const auto point = piercedPoint(b, a[k], a[(k + 1) % 3], error)) return point;
    if (const auto point = piercedPoint(a, b[k], b[(k + 1) % 3], error)) return point;
  }
  return std::nullopt;
}

}  // namespace sdf_ccd
