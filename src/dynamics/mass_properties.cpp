#include "sdf_ccd/simulation.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "common/number_text.h"
#include "common/pi.h"

namespace sdf_ccd {
namespace {

void requireDensity(double density) {
  if (!(density > 0.0) || !std::isfinite(density)) {
    throw std::invalid_argument("mass: density must be finite and positive, got " + numberText(density));
  }
}

/// Moments ∫ p pᵀ dm to the inertia tensor.
Matrix3d inertiaOf(const Matrix3d& moments) {
  return moments.trace() * Matrix3d::Identity() - moments;
}

struct Moments {
  double volume;
  Vector3d second;  ///< ∫ x², y², z² over the solid, divided by its volume [m²]
};

Moments momentsOf(const Sphere& s) {
  return {4.0 / 3.0 * kPi * std::pow(s.radius, 3), Vector3d::Constant(s.radius * s.radius / 5.0)};
}
Moments momentsOf(const Box& b) {
  return {b.size.prod(), b.size.cwiseAbs2() / 12.0};
}
Moments momentsOf(const Cylinder& c) {
  const double across = c.radius * c.radius / 4.0;
  return {kPi * c.radius * c.radius * c.length, {across, across, c.length * c.length / 12.0}};
}
Moments momentsOf(const HalfSpace&) {
  throw std::invalid_argument("mass: a half-space has no finite mass");
}

}  // namespace

MassProperties massProperties(const TriangleMesh& mesh, double density) {
  requireDensity(density);
  validate(mesh);
  const AlignedBox3d box = boundingBox(mesh);
  const Vector3d apex = box.center();
  double volume = 0.0;
  Vector3d first = Vector3d::Zero();   // ∫ p dV
  Matrix3d second = Matrix3d::Zero();  // ∫ p pᵀ dV
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]] - apex, b = mesh.vertices[t[1]] - apex, c = mesh.vertices[t[2]] - apex;
    const double v = a.dot(b.cross(c)) / 6.0;
    const Vector3d sum = a + b + c;
    volume += v;
    first += v / 4.0 * sum;
    // Over a tetrahedron with one corner at the apex: V/20 (Σ pᵢ pᵢᵀ + Σ pᵢ Σ pⱼᵀ).
    second += v / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (!(volume > 1e-12 * box.sizes().prod()) || !(volume > 0.0)) {
    throw std::invalid_argument(
        fmt::format("mass: the mesh encloses no volume ({:g} m³); give mass and inertia", volume));
  }
  const Vector3d center = first / volume;
  return {density * volume, apex + center, density * inertiaOf(second - volume * center * center.transpose())};
}

MassProperties massProperties(const Primitive& primitive, double density) {
  requireDensity(density);
  validate(primitive);
  const Moments solid = std::visit([](const auto& shape) { return momentsOf(shape); }, primitive);
  const double mass = density * solid.volume;
  return {mass, Vector3d::Zero(), inertiaOf(mass * Matrix3d(solid.second.asDiagonal()))};
}

void validateInertia(double mass, const Matrix3d& inertia) {
  const auto refuse = [](const std::string& what, const std::string& value) {
    throw std::invalid_argument(what + ", got " + value);
  };
  if (!(mass > 0.0) || !std::isfinite(mass)) refuse("mass must be finite and positive", numberText(mass));
  const auto row = [&](int i) { return fmt::format("{:g} {:g} {:g}", inertia(i, 0), inertia(i, 1), inertia(i, 2)); };
  const std::string given = row(0) + "; " + row(1) + "; " + row(2);
  if (!inertia.allFinite()) refuse("inertia must be finite", given);
  if (!inertia.isApprox(inertia.transpose(), 1e-9)) refuse("inertia must be symmetric", given);
  const Vector3d moments = Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(moments[0] > 0.0)) refuse("inertia must be positive definite", given);
  if (moments[2] > (moments[0] + moments[1]) * (1.0 + 1e-9)) {
    refuse("no solid has such an inertia (a principal moment exceeds the sum of the others)", given);
  }
}

}  // namespace sdf_ccd
