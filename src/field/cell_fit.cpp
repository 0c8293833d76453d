#include "cell_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sdf_ccd/field/sparse_grid.h"

namespace sdf_ccd {
namespace {

Vector3i corner(int k) {
  return {k & 1, (k >> 1) & 1, k >> 2};
}

}  // namespace

CellFit::CellFit(const NearTriangles& near, const Vector3d& low, double side)
    : near_(near), low_(low), step_(side / kSteps) {
  values_.fill(std::numeric_limits<double>::quiet_NaN());
  sines_.fill(-1.0);
}

double CellFit::at(const Vector3i& p) {
  double& value = values_[index(p)];
  if (std::isnan(value)) value = near_.signedDistance(place(p));
  return value;
}

std::array<double, 8> CellFit::cornersOf(const Cube& cube) {
  std::array<double, 8> values;
  for (int k = 0; k < 8; ++k) values[k] = at(cube.low + cube.side * corner(k));
  return values;
}

double CellFit::sine(const Cube& cube) {
  // The cone of a cube holds for those within it: cubes below half a cell's side do not ask again.
  const int side = std::max(cube.side, kSteps / 2);
  const Vector3i c = cube.low / side;
  double& sine = sines_[side == kSteps ? 0 : 1 + c.x() + 2 * c.y() + 4 * c.z()];
  if (sine < 0.0) {
    const Vector3d center = low_ + step_ * side * (c.cast<double>().array() + 0.5).matrix();
    sine = near_.gradientCone({center, kHalfSqrt3 * step_ * side}).sine;
  }
  return sine;
}

bool CellFit::proved(const Cube& leaf, const std::array<double, 8>& corners, const Cube& cube, double error) {
  double largest = 0.0;
  for (int k = 0; k < 8; ++k) {
    const Vector3i p = cube.low + cube.side * corner(k);
    const Vector3d u = (p - leaf.low).cast<double>() / leaf.side;
    largest = std::max(largest, std::abs(trilinear(corners, u) - at(p)));
    if (largest > error) return false;
  }
  if (largest + kHalfSqrt3 * step_ * cube.side * sine(cube) <= error) return true;
  if (cube.side == 1) return false;
  const int half = cube.side / 2;
  for (int k = 0; k < 8; ++k) {
    if (!proved(leaf, corners, {cube.low + half * corner(k), half}, error)) return false;
  }
  return true;
}

bool CellFit::leaf(const Cube& cube, const LeafScale& scale, double error, LeafWord& word) {
  std::array<double, 8> corners = cornersOf(cube);
  // Curvature pulls the interpolant to one side, most in the middle: half of that, taken off, halves the largest error.
  const Vector3i middle = cube.low.array() + cube.side / 2;
  const double shift = 0.5 * (trilinear(corners, Vector3d::Constant(0.5)) - at(middle));
  if (std::abs(shift) > error) return false;
  for (double& value : corners) value -= shift;
  word = scale.encode(corners);
  return proved(cube, scale.decode(word), cube, error);
}

LeafWord CellFit::roundedLeaf(const Cube& cube, const LeafScale& scale) {
  return scale.encode(cornersOf(cube));
}

}  // namespace sdf_ccd
