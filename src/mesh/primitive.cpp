#include "sdf_ccd/primitive.h"

#include <cmath>

#include "common/infinity.h"
#include "common/number_text.h"
#include "common/pi.h"
#include "common/refuse.h"

namespace sdf_ccd {
namespace {

struct Area {
  double operator()(const Sphere& s) const { return 4 * kPi * s.radius * s.radius; }
  double operator()(const Box& b) const {
    return 2 * (b.size.x() * b.size.y() + b.size.y() * b.size.z() + b.size.z() * b.size.x());
  }
  double operator()(const Cylinder& c) const { return 2 * kPi * c.radius * (c.radius + c.length); }
  double operator()(const HalfSpace&) const { return kInfinity; }
};

struct Validate {
  void operator()(const Sphere& sphere) const { requirePositive("a sphere's radius", sphere.radius); }
  void operator()(const Box& box) const {
    for (int axis = 0; axis < 3; ++axis) requirePositive("a box's size", box.size[axis]);
  }
  void operator()(const Cylinder& cylinder) const {
    requirePositive("a cylinder's radius", cylinder.radius);
    requirePositive("a cylinder's length", cylinder.length);
  }
  void operator()(const HalfSpace& half_space) const {
    if (half_space.normal.allFinite() && std::abs(half_space.normal.norm() - 1) <= 1e-9 &&
        std::isfinite(half_space.offset)) {
      return;
    }
    refuse("a half-space needs a unit normal and a finite offset, not " + vectorText(half_space.normal) + ", " +
           numberText(half_space.offset));
  }
};

/// Signed distance to the region where no coordinate of q is positive: to its corner outside, its nearest side inside.
template <typename Vector>
double cornerDistance(const Vector& q) {
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

/// Gradient of cornerDistance() with respect to q.
template <typename Vector>
Vector cornerGradient(const Vector& q) {
  const Vector outside = q.cwiseMax(0);
  const double norm = outside.norm();
  if (norm > 0) return outside / norm;
  int axis;
  q.maxCoeff(&axis);
  return Vector::Unit(axis);
}

double sign(double x) {
  return x < 0 ? -1.0 : 1.0;
}

Eigen::Vector2d rim(const Cylinder& cylinder, const Vector3d& p) {
  return {p.head<2>().norm() - cylinder.radius, std::abs(p.z()) - cylinder.halfLength()};
}

struct Distance {
  const Vector3d& p;
  double operator()(const Sphere& sphere) const { return p.norm() - sphere.radius; }
  double operator()(const Box& box) const { return cornerDistance<Vector3d>(p.cwiseAbs() - box.halfSize()); }
  double operator()(const Cylinder& cylinder) const { return cornerDistance(rim(cylinder, p)); }
  double operator()(const HalfSpace& half_space) const { return half_space.normal.dot(p) - half_space.offset; }
};

struct Gradient {
  const Vector3d& p;
  Vector3d operator()(const Sphere&) const {
    const double norm = p.norm();
    return norm > 0 ? Vector3d(p / norm) : Vector3d::UnitZ();
  }
  Vector3d operator()(const Box& box) const {
    const Vector3d gradient = cornerGradient<Vector3d>(p.cwiseAbs() - box.halfSize());
    return gradient.cwiseProduct(Vector3d(sign(p.x()), sign(p.y()), sign(p.z())));
  }
  Vector3d operator()(const Cylinder& cylinder) const {
    const Eigen::Vector2d gradient = cornerGradient(rim(cylinder, p));
    const double rho = p.head<2>().norm();
    const Eigen::Vector2d radial = rho > 0 ? Eigen::Vector2d(p.head<2>() / rho) : Eigen::Vector2d::UnitX();
    return {gradient.x() * radial.x(), gradient.x() * radial.y(), gradient.y() * sign(p.z())};
  }
  Vector3d operator()(const HalfSpace& half_space) const { return half_space.normal; }
};

struct Bounds {
  AlignedBox3d operator()(const Sphere& sphere) const { return symmetric(Vector3d::Constant(sphere.radius)); }
  AlignedBox3d operator()(const Box& box) const { return symmetric(box.halfSize()); }
  AlignedBox3d operator()(const Cylinder& cylinder) const {
    return symmetric({cylinder.radius, cylinder.radius, cylinder.halfLength()});
  }
  AlignedBox3d operator()(const HalfSpace&) const { return symmetric(Vector3d::Constant(kInfinity)); }
  static AlignedBox3d symmetric(const Vector3d& half) { return AlignedBox3d(-half, half); }
};

}  // namespace

void validate(const Primitive& primitive) {
  std::visit(Validate{}, primitive);
}

double signedDistance(const Primitive& primitive, const Vector3d& p) {
  return std::visit(Distance{p}, primitive);
}

Vector3d distanceGradient(const Primitive& primitive, const Vector3d& p) {
  return std::visit(Gradient{p}, primitive);
}

AlignedBox3d boundingBox(const Primitive& primitive) {
  return std::visit(Bounds{}, primitive);
}

double surfaceArea(const Primitive& primitive) {
  return std::visit(Area{}, primitive);
}

}  // namespace sdf_ccd
