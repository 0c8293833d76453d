#pragma once

#include <array>

namespace sdf_ccd {

/// A time of a quadrature rule on [0, 1].
struct QuadratureNode {
  double s;
  double weight;
};

/// Three-point Gauss: exact up to degree 5, which d (cubic) times a field's gradient (quadratic) is, and times a
/// constant N and r (linear) (design §3.9).
inline constexpr double kGaussHalfWidth = 0.387298334620741688518;  // √0.15
inline constexpr std::array<QuadratureNode, 3> kGaussNodes = {
    {{0.5 - kGaussHalfWidth, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + kGaussHalfWidth, 5.0 / 18.0}}};

}  // namespace sdf_ccd
