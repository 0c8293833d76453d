#include <cmath>

#include "mesh/triangle_tree.h"

namespace sdf_ccd {

/// Moments of Barill et al. 2018, Eq. (8) to (10), integrated exactly over the triangles: ∫ d_j n_i and
/// ½ ∫ d_j d_k n_i with d = x − center, then made symmetric and traceless.
TriangleTree::Expansion TriangleTree::expand(const Triangle* begin, const Triangle* end) {
  Expansion result{};
  AlignedBox3d box;
  double area = 0;
  const Vector3d& origin = begin->corners()[0];  // because the sum loses digits far from zero
  Vector3d weighted = Vector3d::Zero();
  for (const Triangle* t = begin; t != end; ++t) {
    const auto& [a, b, c] = t->corners();
    box.extend(a).extend(b).extend(c);
    const double weight = areaNormal(t->corners()).norm();
    area += weight;
    weighted += weight * ((a - origin) + (b - origin) + (c - origin)) / 3;
  }
  result.center = area > 0 ? Vector3d(origin + weighted / area) : box.center();

  Matrix3d first = Matrix3d::Zero();  // rows: n, columns: d
  std::array<Matrix3d, 3> second = {Matrix3d::Zero(), Matrix3d::Zero(), Matrix3d::Zero()};
  for (const Triangle* t = begin; t != end; ++t) {
    const Corners& corners = t->corners();
    const Vector3d a = corners[0] - result.center, b = corners[1] - result.center, c = corners[2] - result.center;
    result.radius2 = std::max({result.radius2, a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
    const Vector3d normal = (b - a).cross(c - a) / 2;  // area · n
    const Vector3d sum = a + b + c;
    result.dipole += normal;
    first += normal * (sum / 3).transpose();
    const Matrix3d spread = (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose()) / 12;
    for (int i = 0; i < 3; ++i) second[i] += normal[i] / 2 * spread;
    // |d|³ is convex: its mean over the triangle is at most that of the corners.
    const auto cube = [](double length) { return length * length * length; };
    const double cubes = cube(a.norm()) + cube(b.norm()) + cube(c.norm());
    result.spread += normal.norm() * cubes / 3;
  }

  const Matrix3d symmetric = (first + first.transpose()) / 2 - Matrix3d::Identity() * (first.trace() / 3);
  result.first = {symmetric(0, 0), symmetric(1, 1), symmetric(2, 2), symmetric(0, 1), symmetric(0, 2), symmetric(1, 2)};

  const auto S = [&](int i, int j, int k) { return (second[i](j, k) + second[j](k, i) + second[k](i, j)) / 3; };
  Vector3d trace;
  for (int k = 0; k < 3; ++k) trace[k] = (S(0, 0, k) + S(1, 1, k) + S(2, 2, k)) / 5;
  result.second = {S(0, 0, 0) - 3 * trace.x(), S(1, 1, 1) - 3 * trace.y(),
                   S(2, 2, 2) - 3 * trace.z(), S(0, 0, 1) - trace.y(),
                   S(0, 0, 2) - trace.z(),     S(0, 1, 1) - trace.x(),
                   S(1, 1, 2) - trace.z(),     S(0, 2, 2) - trace.x(),
                   S(1, 2, 2) - trace.y(),     S(0, 1, 2)};
  return result;
}

/// Taylor series of r·n/(4π|r|³) to second order: N·r/ρ³ − 3 M(r,r)/ρ⁵ + 15 S(r,r,r)/ρ⁷.
///
/// The remainder: r·n/|r|³ is the derivative along n of 1/|r + d| = Σ |d|ˡ P_l(−cos γ)/ρˡ⁺¹, γ between r
/// and d, and the gradient of the l-th term is no longer than l |d|ˡ⁻¹/ρˡ⁺¹ (Bernstein's and Szegő's
/// inequality for P_l(cos γ)). The terms from l = 4 on sum to at most |d|³ (4 − 3x)/(1 − x)²/ρ⁵ with x =
/// |d|/ρ, and for x ≤ ½ the factor is at most 4.9 + 20.4 x².
TriangleTree::BoundedNumber TriangleTree::evaluate(const Expansion& expansion, const Vector3d& r, double distance2) {
  constexpr double kFourPi = 12.5663706143591729539;
  const double x = r.x(), y = r.y(), z = r.z();
  const auto& m = expansion.first;
  const auto& s = expansion.second;
  const double first = m[0] * x * x + m[1] * y * y + m[2] * z * z + 2 * (m[3] * x * y + m[4] * x * z + m[5] * y * z);
  const double second = x * x * (s[0] * x + 3 * (s[3] * y + s[4] * z)) +
                        y * y * (s[1] * y + 3 * (s[5] * x + s[6] * z)) +
                        z * z * (s[2] * z + 3 * (s[7] * x + s[8] * y)) + 6 * s[9] * x * y * z;
  const double inverse2 = 1 / distance2;
  const double inverse3 = inverse2 * std::sqrt(inverse2);
  return {inverse3 / kFourPi * (expansion.dipole.dot(r) + inverse2 * (-3 * first + 15 * inverse2 * second)),
          inverse3 * inverse2 * (4.9 + 20.4 * expansion.radius2 * inverse2) / kFourPi * expansion.spread, 0};
}

}  // namespace sdf_ccd
