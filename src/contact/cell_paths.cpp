#include "cell_paths.h"

#include "common/lane_vector.h"
#include "field/trilinear_cell.h"
#include "query/cells/cell_cubic.h"
#include "smooth_piece.h"

namespace sdf_ccd {
namespace {

using namespace lanes;
using Vectors = LaneVector<Doubles>;
using Column = CellPaths::Column;

SDF_CCD_INLINE Doubles load(const Column& column) {
  return lanes::load(column.data());
}

SDF_CCD_INLINE void store(const Doubles& values, Column& column) {
  lanes::store(values, column.data());
}

SDF_CCD_INLINE void addTo(VectorsInMemory& sums, const Vectors& v) {
  lanes::store(lanes::load(sums) + v, sums);
}

SDF_CCD_INLINE Vectors where(const Doubles& first, const Vectors& a, const Vectors& b) {
  const Doubles zero = {};
  return {first > zero ? a.x : b.x, first > zero ? a.y : b.y, first > zero ? a.z : b.z};
}

SDF_CCD_INLINE Vectors gradientAt(const std::array<Doubles, 8>& corners, const Vectors& at) {
  const std::array<Doubles, 3> g = trilinearGradient(corners, at.x, at.y, at.z);
  return {g[0], g[1], g[2]};
}

/// A unit vector along a gradient. @param bears  set to 0 where its square is not above `least2`.
SDF_CCD_INLINE Vectors direction(const Vectors& gradient, const Doubles& least2, Doubles& bears) {
  const Doubles zero = {}, one = zero + 1.0;
  const Doubles squared = gradient.dot(gradient);
  const auto has = squared > least2;
  bears = has ? bears : zero;
  return gradient * (one / squareRoot(has ? squared : one));
}

/// The minima of cubics that rise or fall all along; the others are left to minimumOf().
SDF_CCD_INLINE void findMinima(const std::array<Doubles, 4>& c, CellDepths& depths) {
  const Doubles zero = {}, one = zero + 1.0;
  // As in minimumOf().
  const Doubles middle = c[1] + c[2], last = middle + c[2] + 3.0 * c[3];
  const Doubles least = smaller(smaller(c[1], middle), last), greatest = larger(larger(c[1], middle), last);
  const auto rises = least >= zero, falls = greatest <= zero;
  const Doubles end = c[0] + (c[1] + (c[2] + c[3]));
  store(rises ? zero : (falls ? one : zero - one), depths.u);
  store(rises ? c[0] : end, depths.value);
  for (int i = 0; i < CellPaths::kCount; ++i) {
    if (depths.u[i] >= 0.0) continue;
    const CubicMinimum lowest = minimumOf({{c[0][i], c[1][i], c[2][i], c[3][i]}});
    depths.u[i] = lowest.u;
    depths.value[i] = lowest.value;
  }
}

SDF_CCD_LANES void addPaths(const CellPaths& paths, double duration, const Vector3d& near_F, CellDepths& depths,
                            std::array<CellImpulses::Sum, kGaussNodes.size()>& sums) {
  const Doubles zero = {};
  std::array<Doubles, 8> corners;
  for (int k = 0; k < 8; ++k) corners[k] = load(paths.corners[k]);
  const Vectors from = lanes::load(paths.from), to = lanes::load(paths.to);
  const Vectors d = to - from;
  const std::array<Doubles, 4> c = cubicAlong<Doubles>(corners, {from.x, from.y, from.z}, {d.x, d.y, d.z});
  findMinima(c, depths);

  // As SmoothPiece::gradient().
  const Vectors first = gradientAt(corners, from), last = gradientAt(corners, to),
                middle = gradientAt(corners, from + d * (zero + 0.5));
  const Doubles side = load(paths.side), least2 = side * side * kNoDirection2;
  Doubles bears = zero + 1.0;
  std::array<Vectors, kGaussNodes.size()> normals;
  for (std::size_t i = 0; i < kGaussNodes.size(); ++i) {
    const std::array<double, 3> w = quadraticWeights(kGaussNodes[i].s);
    normals[i] = direction(first * (zero + w[0]) + middle * (zero + w[1]) + last * (zero + w[2]), least2, bears);
  }
  const Vectors N = direction(where(load(depths.u), last, first), least2, bears);
  store(bears, depths.bears);
  lanes::store(N, depths.normal);

  const Doubles stiffness = bears * load(paths.stiffness) * duration, damping = bears * load(paths.damping);
  const Vectors start = lanes::load(paths.start) - Vectors{zero + near_F.x(), zero + near_F.y(), zero + near_F.z()};
  const Vectors step = lanes::load(paths.step);
  for (std::size_t i = 0; i < kGaussNodes.size(); ++i) {
    const Doubles s = zero + kGaussNodes[i].s;
    const Doubles value = c[0] + s * (c[1] + s * (c[2] + s * c[3]));
    // Eq. 3 and 10, as in Integrator::addNode().
    const Vectors bearing = normals[i] * (-kGaussNodes[i].weight * stiffness * smaller(value, zero));
    const Vectors impulse = bearing - step * (kGaussNodes[i].weight * damping);
    addTo(sums[i].impulse, impulse);
    addTo(sums[i].angular, (start + step * s).cross(impulse));
  }
}

using FourInts = std::int32_t __attribute__((vector_size(kWidth * sizeof(std::int32_t))));

/// The cells of paths in a grid.
struct LocatedPaths {
  std::array<std::array<std::int32_t, CellPaths::kCount>, 3> cell;
  Column within;  ///< 1 if the path is in the box and stays in the cell; else 0
};

SDF_CCD_LANES void locate(const GridShape& shape, CellPaths& paths, LocatedPaths& located) {
  const Doubles zero = {}, one = zero + 1.0;
  const Vector3i count = shape.cells();
  const AlignedBox3d box = shape.box();
  Doubles within = one;
  for (int k = 0; k < 3; ++k) {
    const Doubles start = load(paths.start[k]), end = start + load(paths.step[k]);
    const Doubles from = (start - shape.origin[k]) / shape.cell, to = (end - shape.origin[k]) / shape.cell;
    // A number for NaN, too.
    const Doubles held = smaller(larger(from, zero), zero + (count[k] - 1.0));
    const FourInts cell = __builtin_convertvector(held, FourInts);  // rounds towards zero
    const Doubles low = __builtin_convertvector(cell, Doubles), from_low = from - low, to_low = to - low;
    within = start >= zero + box.min()[k] ? within : zero;
    within = start <= zero + box.max()[k] ? within : zero;
    within = to_low >= zero ? within : zero;
    within = to_low < one ? within : zero;
    store(smaller(larger(from_low, zero), one), paths.from[k]);
    store(smaller(larger(to_low, zero), one), paths.to[k]);
    for (int i = 0; i < kWidth; ++i) located.cell[k][i] = cell[i];
  }
  store(within, located.within);
  store(zero + shape.cell, paths.side);
}

/// Samples of the corners, in steps.
using CornerSamples = std::array<std::array<std::int32_t, CellPaths::kCount>, 8>;

SDF_CCD_LANES void setCorners(const CornerSamples& samples, double step, CellPaths& paths) {
  for (int k = 0; k < 8; ++k) {
    const auto& s = samples[k];
    store(__builtin_convertvector((FourInts{s[0], s[1], s[2], s[3]}), Doubles) * step, paths.corners[k]);
  }
}

double sumOf(const Column& column) {
  double sum = 0.0;
  for (const double value : column) sum += value;
  return sum;
}

Vector3d sumOf(const std::array<Column, 3>& columns) {
  return {sumOf(columns[0]), sumOf(columns[1]), sumOf(columns[2])};
}

}  // namespace

unsigned placeInGrid(const SparseGrid& grid, CellPaths& paths) {
  LocatedPaths located;
  locate(grid.shape(), paths, located);
  CornerSamples samples = {};
  unsigned placed = 0;
  for (int i = 0; i < CellPaths::kCount; ++i) {
    if (located.within[i] == 0.0) continue;
    const Vector3i cell(located.cell[0][i], located.cell[1][i], located.cell[2][i]);
    const std::int32_t slot = grid.slot(GridShape::brickOf(cell));
    if (slot == SparseGrid::kFar) continue;
    placed |= 1U << i;
    const std::array<std::int16_t, 8> corners = grid.cellSamples(slot, GridShape::inBrick(cell));
    for (int k = 0; k < 8; ++k) samples[k][i] = corners[k];
  }
  setCorners(samples, grid.shape().step, paths);
  return placed;
}

void CellImpulses::add(const CellPaths& paths, double duration, CellDepths& depths) {
  // About a point nearby, moments keep the precision that they lose about an origin far away.
  if (!bears_) near_F_ = {paths.start[0][0], paths.start[1][0], paths.start[2][0]};
  bears_ = true;
  addPaths(paths, duration, near_F_, depths, sums_);
}

void CellImpulses::moveTo(ChordImpulses& impulses) {
  if (!bears_) return;
  for (std::size_t i = 0; i < kGaussNodes.size(); ++i)
    impulses.add(kGaussNodes[i].s, near_F_, Wrench{sumOf(sums_[i].impulse), sumOf(sums_[i].angular)});
  *this = {};
}

}  // namespace sdf_ccd
