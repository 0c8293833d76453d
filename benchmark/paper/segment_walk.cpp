#include "segment_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sdf_ccd::benchmark {
namespace {

constexpr int kMaxBisections = 5;
constexpr double kConverged = 1e-3;  ///< [cells]; the paper gives no value

/// A segment in units of cells, clipped to the grid's box.
struct Walk {
  Vector3d o, d;
  double t, t_end;
  std::array<int, 3> cell;

  bool enter(const DenseField& field, const Segment& segment) {
    o = (segment.start - field.origin) / field.cell;
    d = (segment.end - segment.start) / field.cell;
    t = 0.0;
    t_end = 1.0;
    for (int k = 0; k < 3; ++k) {
      if (d[k] == 0.0) {
        if (o[k] < 0.0 || o[k] > field.cells) return false;
        continue;
      }
      const double a = -o[k] / d[k], b = (field.cells - o[k]) / d[k];
      t = std::max(t, std::min(a, b));
      t_end = std::min(t_end, std::max(a, b));
    }
    if (t > t_end) return false;
    for (int k = 0; k < 3; ++k) cell[k] = std::clamp(int(std::floor(o[k] + t * d[k])), 0, field.cells - 1);
    return true;
  }
};

/// φ − σ along the segment inside a cell.
class Cell {
 public:
  Cell(const DenseField& field, const Walk& walk, double sigma) : walk_(walk), sigma_(sigma) {
    const float* s = field.samples.get() + field.index(walk.cell[0], walk.cell[1], walk.cell[2]);
    const std::size_t y = field.strideY(), z = field.strideZ();
    corners_ = {s[0], s[1], s[y], s[y + 1], s[z], s[z + 1], s[z + y], s[z + y + 1]};
  }

  bool holdsIsosurface() const {
    int above = 0;
    for (const float c : corners_) above += double(c) > sigma_;
    return above % 8 != 0;
  }

  double value(double t) const {
    std::array<double, 3> u;
    for (int k = 0; k < 3; ++k) u[k] = std::clamp(walk_.o[k] + t * walk_.d[k] - walk_.cell[k], 0.0, 1.0);
    const auto& c = corners_;
    const double x0 = c[0] + u[0] * (c[1] - c[0]), x1 = c[2] + u[0] * (c[3] - c[2]);
    const double x2 = c[4] + u[0] * (c[5] - c[4]), x3 = c[6] + u[0] * (c[7] - c[6]);
    const double y0 = x0 + u[1] * (x1 - x0), y1 = x2 + u[1] * (x3 - x2);
    return y0 + u[2] * (y1 - y0) - sigma_;
  }

 private:
  const Walk& walk_;
  double sigma_;
  std::array<float, 8> corners_;
};

/// Adds the time of the crossing between t0 and t1 if the signs at them differ (Eq. 2, Figure 1).
void addCrossing(const Cell& cell, double t0, double t1, double tolerance, std::vector<double>& times) {
  double f0 = cell.value(t0), f1 = cell.value(t1);
  if ((f0 < 0.0) == (f1 < 0.0)) return;
  double t = t0;
  for (int i = 0; i < kMaxBisections; ++i) {
    t = t0 + (t1 - t0) * f0 / (f0 - f1);
    const double f = cell.value(t);
    if (std::abs(f) <= tolerance) break;
    ((f < 0.0) == (f0 < 0.0) ? t0 : t1) = t;
    ((f < 0.0) == (f0 < 0.0) ? f0 : f1) = f;
  }
  times.push_back(t);
}

struct Step {
  int axis;
  double t;
};

/// Visits all cells one after the other (digital differential analyser, Amanatides & Woo 1987).
class CellByCell {
 public:
  CellByCell(const DenseField&, const Walk& walk) {
    for (int k = 0; k < 3; ++k) {
      const bool up = walk.d[k] > 0.0;
      step_[k] = up ? 1 : -1;
      const bool moves = walk.d[k] != 0.0;
      delta_[k] = moves ? std::abs(1.0 / walk.d[k]) : 0.0;
      next_[k] =
          moves ? (walk.cell[k] + (up ? 1 : 0) - walk.o[k]) / walk.d[k] : std::numeric_limits<double>::infinity();
    }
  }

  bool mayCross(const Walk&, double) const { return true; }

  Step exit(const Walk&) const {
    int axis = next_[1] < next_[0] ? 1 : 0;
    if (next_[2] < next_[axis]) axis = 2;
    return {axis, next_[axis]};
  }

  void advance(const Step& step, Walk& walk) {
    walk.cell[step.axis] += step_[step.axis];
    next_[step.axis] += delta_[step.axis];
  }

 private:
  std::array<int, 3> step_;
  std::array<double, 3> delta_, next_;
};

/// Skips blocks of the octree.
class BlockByBlock {
 public:
  BlockByBlock(const MinMaxOctree& octree) : octree_(octree) {}

  /// False if a block around the cell is free of the isosurface; stores the largest such block.
  bool mayCross(const Walk& walk, double sigma) {
    for (std::size_t level = octree_.levels.size(); level-- > 0;) {
      const auto& range = octree_.range(level, walk.cell[0], walk.cell[1], walk.cell[2]);
      if (sigma <= range.min || sigma >= range.max) {
        shift_ = int(level) + 1;
        return false;
      }
    }
    shift_ = 0;
    return true;
  }

  Step exit(const Walk& walk) const {
    Step step{0, std::numeric_limits<double>::infinity()};
    for (int k = 0; k < 3; ++k) {
      if (walk.d[k] == 0.0) continue;
      const int face = ((walk.cell[k] >> shift_) + (walk.d[k] > 0.0 ? 1 : 0)) << shift_;
      const double t = (face - walk.o[k]) / walk.d[k];
      if (t < step.t) step = {k, t};
    }
    return step;
  }

  void advance(const Step& step, Walk& walk) const {
    for (int k = 0; k < 3; ++k) {
      const int low = walk.cell[k] >> shift_ << shift_, high = low + (1 << shift_);
      walk.cell[k] = k == step.axis ? (walk.d[k] > 0.0 ? high : low - 1)
                                    : std::clamp(int(std::floor(walk.o[k] + step.t * walk.d[k])), low, high - 1);
    }
  }

 private:
  const MinMaxOctree& octree_;
  int shift_ = 0;
};

template <class Traversal>
void traverse(const DenseField& field, Traversal traversal, Walk& walk, const SegmentOptions& options,
              std::vector<double>& times) {
  const double sigma = options.sigma;
  const bool first_only = options.mode != SegmentMode::kAll;
  bool inside = Cell(field, walk, sigma).value(walk.t) < 0.0;  // the paper's sign flag
  if (inside) times.push_back(walk.t);
  while (!(first_only && !times.empty())) {
    const bool may_cross = traversal.mayCross(walk, sigma);
    const Step step = traversal.exit(walk);
    const double t_exit = std::min(step.t, walk.t_end);
    if (may_cross) {
      const Cell cell(field, walk, sigma);
      const std::size_t before = times.size();
      if (cell.holdsIsosurface()) addCrossing(cell, walk.t, t_exit, kConverged * field.cell, times);
      if (times.size() != before) inside = !inside;
    }
    if (step.t >= walk.t_end) break;
    traversal.advance(step, walk);
    if (walk.cell[step.axis] < 0 || walk.cell[step.axis] >= field.cells) break;
    walk.t = t_exit;
  }
  if (inside && !first_only) times.push_back(walk.t_end);
}

}  // namespace

void paperIntervals(const DenseField& field, const MinMaxOctree* octree, const Segment& segment, double sigma,
                    bool first_only, std::vector<double>& times) {
  times.clear();
  Walk walk;
  if (!walk.enter(field, segment)) return;
  const SegmentOptions options{sigma, first_only ? SegmentMode::kFirst : SegmentMode::kAll};
  if (octree) {
    traverse(field, BlockByBlock(*octree), walk, options, times);
  } else {
    traverse(field, CellByCell(field, walk), walk, options, times);
  }
}

}  // namespace sdf_ccd::benchmark
