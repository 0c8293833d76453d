#include "mesh/triangle.h"

#include <algorithm>
#include <cmath>

#include "common/pi.h"

namespace sdf_ccd {
namespace {

/// Below this square of height over length, Ericson's tests lose more than half their digits.
constexpr double kSliver = 1e-8;

Vector3d closestByRegions(const Corners& triangle, const Vector3d& p) {
  const auto& [a, b, c] = triangle;
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double scale = 1 / (va + vb + vc);
  return a + ab * (vb * scale) + ac * (vc * scale);
}

bool isSliver(const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3d ab = b - a, ac = c - a;
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  return !(ab.cross(ac).squaredNorm() > kSliver * longest2 * longest2);
}

Vector3d closestOnSliver(const Corners& triangle, const Vector3d& p) {
  const auto& [a, b, c] = triangle;
  Vector3d best = closestOnSegment(a, b, p);
  const auto offer = [&](const Vector3d& q) {
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  };
  offer(closestOnSegment(b, c, p));
  offer(closestOnSegment(c, a, p));
  // The interior, by the foot of the perpendicular and its barycentric coordinates, clamped to the triangle.
  const Vector3d ab = b - a, ac = c - a, normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  if (area2 > 0) {
    const Vector3d ap = p - a;
    const double v = std::clamp(ap.cross(ac).dot(normal) / area2, 0.0, 1.0);
    const double w = std::clamp(ab.cross(ap).dot(normal) / area2, 0.0, 1.0 - v);
    offer(a + ab * v + ac * w);
  }
  return best;
}

/// About the centre of the triangle's box, projected onto the triangle's plane; for a sliver about the centre itself.
FlatCylinder discAbout(const Corners& triangle, bool sliver) {
  const auto& [a, b, c] = triangle;
  const Vector3d middle = 0.5 * (a.cwiseMin(b).cwiseMin(c) + a.cwiseMax(b).cwiseMax(c));
  const Vector3d normal = sliver ? Vector3d::Zero() : Vector3d(areaNormal(triangle).normalized());
  FlatCylinder disc{middle - normal.dot(middle - a) * normal, normal};
  for (const Vector3d& corner : triangle) disc.extend(corner);
  return disc;
}

}  // namespace

Vector3d closestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const Vector3d ab = b - a;
  const double length2 = ab.squaredNorm();
  if (!(length2 > 0)) return a;
  const double t = ab.dot(p - a) / length2;
  if (t >= 1) return b;
  return t > 0 ? Vector3d(a + ab * t) : a;
}

Vector3d closestOnTriangle(const Corners& triangle, const Vector3d& p) {
  return isSliver(triangle) ? closestOnSliver(triangle, p) : closestByRegions(triangle, p);
}

MeasuredTriangle::MeasuredTriangle(const Corners& corners)
    : corners_(corners), sliver_(isSliver(corners)), disc_(discAbout(corners, sliver_)) {}

Vector3d MeasuredTriangle::closest(const Vector3d& p) const {
  return sliver_ ? closestOnSliver(corners_, p) : closestByRegions(corners_, p);
}

void SolidAngleSum::add(const Corners& triangle) {
  const Vector3d pa = triangle[0] - p_, pb = triangle[1] - p_, pc = triangle[2] - p_;
  const double la = pa.norm(), lb = pb.norm(), lc = pc.norm();
  const double y = pa.dot(pb.cross(pc));
  const double x = la * lb * lc + pa.dot(pb) * lc + pb.dot(pc) * la + pc.dot(pa) * lb;
  if (x == 0.0 && y == 0.0) return;
  const double real = real_ * x - imaginary_ * y, imaginary = real_ * y + imaginary_ * x;
  // Two arguments of one sign, whose sum has the other, have passed ±π.
  const bool up = imaginary_ >= 0.0;
  if (up == (y >= 0.0) && up != (imaginary >= 0.0)) turns_ += up ? 1.0 : -1.0;
  real_ = real;
  imaginary_ = imaginary;
  constexpr double kSmall = 1e-100, kLarge = 1e100;
  const double size = std::abs(real) + std::abs(imaginary);
  if (size > kSmall && size < kLarge) return;
  turns_ = value();
  real_ = 1.0;
  imaginary_ = 0.0;
}

double SolidAngleSum::value() const {
  return turns_ + std::atan2(imaginary_, real_) / (2.0 * kPi);
}

}  // namespace sdf_ccd
