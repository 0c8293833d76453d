#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::test {

/// A grid as the oracle sees it: unit cubes, each with the values of the cell to which it belongs.
struct Lattice {
  Vector3d origin;
  double cell;  ///< side of a unit cube [m]
  Vector3i size;

  AlignedBox3d box() const { return {origin, origin + cell * size.cast<double>()}; }
};

inline Lattice latticeOf(const DistanceField& field) {
  if (const AdaptiveGrid* grid = FieldAccess::adaptive(field)) {
    return {grid->shape().origin, grid->shape().unit(), grid->shape().units()};
  }
  return {FieldAccess::grid(field)->shape().origin, FieldAccess::grid(field)->shape().cell,
          FieldAccess::grid(field)->shape().cells()};
}

/// The cell that a unit cube belongs to.
struct LatticeCell {
  Vector3i low;  ///< [unit cubes]
  int side;
  bool sampled;  ///< false: a far cell, whose side of the surface is the sign of corners[0]
  std::array<double, 8> corners;
};

inline LatticeCell latticeCell(const DistanceField& field, const Vector3i& c) {
  if (const AdaptiveGrid* grid = FieldAccess::adaptive(field)) {
    const AdaptiveBlock block = grid->block(c);
    if (!block.leaf) return {block.low, block.side, false, {block.inside ? -1.0 : 1.0}};
    return {block.low, block.side, true, grid->corners(block)};
  }
  const SparseGrid& grid = *FieldAccess::grid(field);
  const Vector3i brick = c / GridShape::kBrick;
  const std::int32_t slot = grid.slot(brick);
  if (slot == SparseGrid::kFar) return {c, 1, false, grid.brickCorners(brick)};
  return {c, 1, true, grid.cellCorners(slot, c - GridShape::kBrick * brick)};
}

/// The segment query by brute force in long double: visits every cell that the segment crosses; in each it fits the
/// cubic through four values, finds its extrema, and bisects 120 times per root. No hierarchy, no skipping.
class UniformWalk {
 public:
  struct Span {
    long double enter, exit, lowest;  ///< `lowest` is the smallest φ − σ in the span [m]
  };

  UniformWalk(const DistanceField& field, const Segment& segment, double sigma)
      : field_(field), lattice_(latticeOf(field)), segment_(segment), sigma_(sigma) {}

  std::vector<Span> spans() const {
    std::vector<long double> cuts{0.0L, 1.0L};
    for (int k = 0; k < 3; ++k) {
      const long double a = place(0.0L)[k], b = place(1.0L)[k];
      if (a == b) continue;
      const int first = int(std::max(0.0L, std::floor(std::min(a, b)))), last = lattice_.size[k];
      for (int plane = first; plane <= last && plane <= std::ceil(std::max(a, b)); ++plane) {
        const long double t = (plane - a) / (b - a);
        if (t > 0.0L && t < 1.0L) cuts.push_back(t);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<Span> found;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) cell(cuts[i], cuts[i + 1], found);
    return found;
  }

  /// φ − σ at t; +1 outside the grid.
  long double value(long double t) const {
    const std::array<long double, 3> p = place(t);
    return valueIn(p, cellOf(t));
  }

 private:
  using Place = std::array<long double, 3>;

  Place place(long double t) const {
    Place p;
    for (int k = 0; k < 3; ++k) {
      const long double a = segment_.start[k], b = segment_.end[k];
      p[k] = (a + t * (b - a) - lattice_.origin[k]) / lattice_.cell;
    }
    return p;
  }

  Vector3i cellOf(long double t) const {
    const Place p = place(t);
    Vector3i c;
    for (int k = 0; k < 3; ++k) c[k] = int(std::floor(p[k]));
    for (int k = 0; k < 3; ++k) {
      if (p[k] == lattice_.size[k]) --c[k];  // the last plane belongs to the last cell
    }
    return c;
  }

  long double valueIn(const Place& p, const Vector3i& c) const {
    if (c.minCoeff() < 0 || (lattice_.size - c).minCoeff() < 1) return 1.0L;
    const LatticeCell cell = latticeCell(field_, c);
    if (!cell.sampled) return cell.corners[0] > 0.0 ? 1.0L : -1.0L;
    long double sum = -static_cast<long double>(sigma_);
    for (int k = 0; k < 8; ++k) {
      long double weight = 1.0L;
      for (int axis = 0; axis < 3; ++axis) {
        const long double u = (p[axis] - cell.low[axis]) / cell.side;
        weight *= (k >> axis) & 1 ? u : 1.0L - u;
      }
      sum += weight * cell.corners[k];
    }
    return sum;
  }

  void cell(long double t0, long double t1, std::vector<Span>& found) const {
    if (t1 <= t0) return;
    const Vector3i c = cellOf(0.5L * (t0 + t1));
    const auto f = [&](long double u) { return valueIn(place(t0 + u * (t1 - t0)), c); };
    // The cubic through its values at 0, 1/3, 2/3 and 1.
    const long double f0 = f(0), f1 = f(1.0L / 3), f2 = f(2.0L / 3), f3 = f(1);
    const long double c1 = (-11 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / 2;
    const long double c2 = 9 * (2 * f0 - 5 * f1 + 4 * f2 - f3) / 2, c3 = 9 * (-f0 + 3 * f1 - 3 * f2 + f3) / 2;
    std::vector<long double> u{0.0L};
    const long double a = 3 * c3, b = 2 * c2, discriminant = b * b - 4 * a * c1;
    if (discriminant > 0) {
      const long double q = -0.5L * (b + std::copysign(std::sqrt(discriminant), b));
      for (const long double r : {q / a, c1 / q})
        if (r > 0 && r < 1) u.push_back(r);
    }
    std::sort(u.begin(), u.end());
    u.push_back(1.0L);
    for (std::size_t i = 0; i + 1 < u.size(); ++i) monotone(f, u[i], u[i + 1], t0, t1, found);
  }

  template <class Function>
  void monotone(const Function& f, long double a, long double b, long double t0, long double t1,
                std::vector<Span>& found) const {
    const long double fa = f(a), fb = f(b);
    if (fa > 0 && fb > 0) return;
    long double enter = a, exit = b;
    if ((fa > 0) != (fb > 0)) {
      long double in = fa > 0 ? b : a, out = fa > 0 ? a : b;
      for (int i = 0; i < 120; ++i) {
        const long double middle = 0.5L * (in + out);
        (f(middle) > 0 ? out : in) = middle;
      }
      (fa > 0 ? enter : exit) = in;
    }
    const long double start = t0 + enter * (t1 - t0), end = t0 + exit * (t1 - t0), lowest = std::min(fa, fb);
    if (!found.empty() && start <= found.back().exit + 1e-15L) {
      found.back().exit = std::max(found.back().exit, end);
      found.back().lowest = std::min(found.back().lowest, lowest);
    } else {
      found.push_back({start, end, lowest});
    }
  }

  const DistanceField& field_;
  Lattice lattice_;
  Segment segment_;
  double sigma_;
};

}  // namespace sdf_ccd::test
