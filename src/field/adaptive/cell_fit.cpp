#include "cell_fit.h"
#include "field/grid_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sdf_ccd {
namespace {

/// A cube's corner values and the means between them.
std::array<double, 27> refined(const std::array<double, 8>& corners) {
  std::array<double, 27> v;
  for (int k = 0; k < 8; ++k) v[2 * (k & 1) + 6 * ((k >> 1) & 1) + 18 * (k >> 2)] = corners[k];
  for (int z = 0; z < 27; z += 18)
    for (int y = 0; y < 9; y += 6) v[z + y + 1] = 0.5 * (v[z + y] + v[z + y + 2]);
  for (int z = 0; z < 27; z += 18)
    for (int x = 0; x < 3; ++x) v[z + 3 + x] = 0.5 * (v[z + x] + v[z + 6 + x]);
  for (int i = 0; i < 9; ++i) v[9 + i] = 0.5 * (v[i] + v[18 + i]);
  return v;
}

std::array<double, 8> octantOf(const std::array<double, 27>& lattice, int k) {
  const double* v = lattice.data() + (k & 1) + 3 * ((k >> 1) & 1) + 9 * (k >> 2);
  return {v[0], v[1], v[3], v[4], v[9], v[10], v[12], v[13]};
}

std::array<double, 27> difference(std::array<double, 27> a, const std::array<double, 27>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

Deviation deviationOf(const std::array<double, 27>& errors) {
  const auto [low, high] = std::minmax_element(errors.begin(), errors.end());
  return {*high, -*low};
}

}  // namespace

CellFit::CellFit(const NearTriangles& near)
    : near_(near), low_(near.cube().center.array() - 0.5 * near.cube().side), step_(near.cube().side / kSteps) {
  values_.fill(std::numeric_limits<double>::quiet_NaN());
  set(Vector3i::Constant(kSteps / 2), near.centerDistance());
}

CellFit::CellFit(const NearTriangles& near, CellFit& around, const Vector3i& part) : CellFit(near) {
  const Cube cube{kSteps / 4 * part, kSteps / 4};
  around.sample(cube, 1, near);
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        set(kSteps / 2 * Vector3i(x, y, z), around.at(cube.low + kSteps / 8 * Vector3i(x, y, z)));
      }
  set(Vector3i::Constant(kSteps / 2), near.centerDistance());
}

NearOctants& CellFit::octants() {
  if (!octants_) octants_.emplace(near_);
  return *octants_;
}

void CellFit::sample(const Cube& cube, int steps, const NearTriangles& near) {
  DistanceWriter<double> writer(near, values_.data());
  const int first = index(cube.low), step = cube.side / steps;
  for (int z = 0; z <= steps; ++z)
    for (int y = 0; y <= steps; ++y)
      for (int x = 0; x <= steps; ++x) {
        const int i = first + step / kKept * (x + kSide * (y + kSide * z));
        if (std::isnan(values_[i])) writer.add(i, point(cube.low + step * Vector3i(x, y, z)));
      }
}

CellFit::CornerValues CellFit::cornersOf(const Cube& cube) const {
  CornerValues values;
  for (int k = 0; k < 8; ++k) values[k] = at(cube.low + cube.side * cubeCorner(k));
  return values;
}

CellFit::Lattice CellFit::latticeOf(const Cube& cube, const NearTriangles& near) {
  const int half = cube.side / 2;
  if (half % kKept != 0) return finestLattice(cube, near);
  sample(cube, 2, near);
  Lattice values;
  const double* const first = values_.data() + index(cube.low);
  for (int z = 0, i = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x, ++i) values[i] = first[half / kKept * (x + kSide * (y + kSide * z))];
  return values;
}

CellFit::Lattice CellFit::finestLattice(const Cube& cube, const NearTriangles& near) const {
  Lattice values;
  {
    DistanceWriter<double> writer(near, values.data());
    for (int i = 0; i < 27; ++i) {
      const Vector3i step(i % 3, i / 3 % 3, i / 9);
      if ((step.array() != 1).all()) {
        values[i] = at(cube.low + step);
      } else {
        writer.add(i, point(cube.low + step));
      }
    }
  }
  return values;
}

Deviation CellFit::deviation(const Cube& cube, const NearTriangles& near, const GradientBound& bound,
                             const Lattice& exact, const CornerValues& leaf, double max_deviation) {
  const Deviation seen = deviationOf(difference(refined(leaf), exact));
  if (seen.largest() > max_deviation) return seen;
  const Deviation whole = bound.deviation(step_ * cube.side, cornersOf(cube), leaf, seen);
  // A bound far above the errors found is due to the gradients' range: parts have a smaller range.
  constexpr double kTight = 2.0;
  if (whole.largest() <= std::min(max_deviation, kTight * seen.largest())) return whole;
  const Deviation in_parts = deviationInParts(cube, near, bound, exact, leaf, max_deviation);
  return whole.largest() < std::min(max_deviation, in_parts.largest()) ? whole : in_parts;
}

Deviation CellFit::deviationInParts(const Cube& cube, const NearTriangles& near, const GradientBound& bound,
                                    const Lattice& exact, const CornerValues& leaf, double max_deviation) {
  const Lattice values = refined(leaf);
  Deviation worst = deviationOf(difference(values, exact));
  std::optional<NearOctants> own;
  for (int k = 0; k < 8 && worst.largest() <= max_deviation; ++k) {
    const Cube part{cube.low + cube.side / 2 * cubeCorner(k), cube.side / 2};
    const CornerValues part_exact = octantOf(exact, k), part_leaf = octantOf(values, k);
    Deviation found = bound.deviation(step_ * part.side, part_exact, part_leaf, worst);
    if (found.largest() > max_deviation) {
      if (cube.side < kSteps && !own) own.emplace(near);
      const NearTriangles& part_near = cube.side == kSteps ? octants()[k] : (*own)[k];
      std::optional<GradientBound> own_bound;
      if (part_near.size() < near.size()) {
        own_bound.emplace(part_near);
        found = own_bound->deviation(step_ * part.side, part_exact, part_leaf, worst);
      }
      if (found.largest() > max_deviation && part.side > 1) {
        const GradientBound& part_bound = own_bound ? *own_bound : bound;
        found = deviationInParts(part, part_near, part_bound, latticeOf(part, part_near), part_leaf, max_deviation);
      }
    }
    worst.include(found);
  }
  return worst;
}

std::optional<FittedLeaf> CellFit::leaf(const Cube& cube, const NearTriangles& near, const LeafScale& scale,
                                        double max_deviation) {
  sample(cube, 1, near);
  const Vector3i middle = cube.low.array() + cube.side / 2;
  if (std::isnan(at(middle))) set(middle, near.centerDistance());
  CornerValues corners = cornersOf(cube);
  const double mean = std::accumulate(corners.begin(), corners.end(), 0.0) / 8.0;
  if (std::abs(mean - at(middle)) > 2.0 * max_deviation) return std::nullopt;
  // Curvature makes the interpolant deviate to one side: subtracting half of that halves the largest error.
  const Lattice exact = latticeOf(cube, near);
  const Deviation seen = deviationOf(difference(refined(corners), exact));
  if (seen.above + seen.below > 2.0 * max_deviation) return std::nullopt;
  for (double& value : corners) value -= 0.5 * (seen.above - seen.below);
  // If the error between these points is too large after this correction, it determines the next one.
  const GradientBound bound(near);
  constexpr int kTries = 4;
  for (int i = 0; i < kTries; ++i) {
    const LeafWord word = scale.encode(corners);
    const Deviation found = deviation(cube, near, bound, exact, scale.decode(word), max_deviation);
    if (found.largest() <= max_deviation) return FittedLeaf{word, found.largest()};
    if (found.above + found.below > 2.0 * max_deviation) break;
    for (double& value : corners) value -= 0.5 * (found.above - found.below);
  }
  return std::nullopt;
}

std::optional<FittedLeaf> CellFit::leaf(const LeafScale& scale, double max_deviation) {
  return leaf({Vector3i::Zero(), kSteps}, near_, scale, max_deviation);
}

std::optional<FittedLeaf> CellFit::octantLeaf(int k, const LeafScale& scale, double max_deviation) {
  return leaf(octantCube(k), octants()[k], scale, max_deviation);
}

FittedLeaf CellFit::roundedLeaf(int k, const LeafScale& scale) {
  const Cube cube = octantCube(k);
  sample(cube, 1, octants()[k]);
  return {scale.encode(cornersOf(cube)), kHalfSqrt3 * step_ * cube.side + scale.rounding()};
}

}  // namespace sdf_ccd
