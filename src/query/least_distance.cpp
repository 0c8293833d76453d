#include "least_distance.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <vector>

#include "common/infinity.h"
#include "field/field_access.h"
#include "field/uniform/sample_bracket.h"
#include "field/uniform/sparse_grid.h"
#include "query/cells/adaptive_walk.h"
#include "segment_reach.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxSamples = 128;  ///< upper bound of the samples on a path

/// A lower bound of the distance function: a cone, or a tangent plane if the distance is convex (a primitive's).
struct LowerFunction {
  LowerCone cone;
  Vector3d tangent;
  bool is_tangent;

  double operator()(const Vector3d& p_F) const {
    return is_tangent ? cone.distance + tangent.dot(p_F - cone.apex) : cone(p_F);
  }
};

/// Minimises the distance along the path by lower bounds: the next sample is where the path's lower bound is smallest,
/// until that is close to the smallest value found (Piyavskii and Shubert's method for Lipschitz functions). Across the
/// gradient, the cone of a grid's sample far up it is nearly as flat as the distance, so few samples are needed.
class LeastSearch {
 public:
  LeastSearch(const DistanceField& field, const Segment& segment)
      : field_(field),
        grid_(FieldAccess::grid(field)),
        start_(segment.start),
        displacement_(segment.end - segment.start),
        length_(displacement_.norm()) {}

  LeastDistance run() {
    sampleAt(0.0);
    best_.low = best_.value - best_error_;
    if (length_ == 0.0) return best_;
    sampleAt(1.0);
    push(0, 1);
    while (true) {
      const Piece piece = pieces_.top();
      best_.low = piece.low;
      const double known = best_.value - best_error_;
      const double slack = 0.25 * best_error_ + 0.01 * field_.errorBound() + 1e-9 * length_;
      if (piece.low >= known - slack || !piece.may_rise || samples_.size() >= kMaxSamples) return best_;
      pieces_.pop();
      const int middle = sampleAt(piece.at);
      push(piece.from, middle);
      push(middle, piece.to);
    }
  }

 private:
  struct Sample {
    double t;
    Vector3d p;
    LowerFunction lower;
    double error;  ///< [m]
  };

  struct Piece {
    int from, to;   ///< indices of samples
    double low;     ///< lower bound of the distance on the piece [m]
    double at;      ///< t of the next sample
    bool may_rise;  ///< whether a sample there can raise `low`

    bool operator<(const Piece& other) const { return low > other.low; }
  };

  int sampleAt(double t) {
    const Vector3d p = start_ + t * displacement_;
    std::optional<LowerCone> cone;
    if (grid_ && field_.box().contains(p)) {
      const FieldValue at = field_.interpolate(p);
      cone = sampleCone(*grid_, p, at.gradient);
      // An upper bound of the distance is computed only where the value is the smallest so far.
      if (cone && at.value >= best_.value) return add({t, p, {*cone, Vector3d::Zero(), false}, at.value - (*cone)(p)});
    }
    const FieldSample at = field_.sample(p);
    if (at.value < best_.value) {
      best_.time = t;
      best_.value = at.value;
      best_error_ = at.error;
    }
    best_.high = std::min(best_.high, at.value + at.error);
    if (!cone) cone = LowerCone{p, at.value - at.error};
    return add({t, p, {*cone, at.gradient, field_.primitive() != nullptr}, at.error});
  }

  int add(const Sample& sample) {
    samples_.push_back(sample);
    return static_cast<int>(samples_.size()) - 1;
  }

  /// Along the path cones are concave, so their chords between the two samples are lower bounds; the larger of the two
  /// chords is smallest where they intersect.
  void push(int from, int to) {
    const Sample &a = samples_[from], &b = samples_[to];
    const double a_from = a.lower(a.p), a_to = a.lower(b.p), b_from = b.lower(a.p), b_to = b.lower(b.p);
    const double ahead_from = a_from - b_from, ahead_to = b_to - a_to, width = b.t - a.t;
    const double at_from = std::max(a_from, b_from), at_to = std::max(a_to, b_to);
    Piece piece{from, to, std::min(at_from, at_to), 0.5 * (a.t + b.t), false};
    if (ahead_from > 0.0 && ahead_to > 0.0) {
      const double share = ahead_from / (ahead_from + ahead_to), low = a_from + share * (a_to - a_from);
      if (low < piece.low) {
        piece.low = low;
        piece.at = a.t + std::clamp(share, 0.1, 0.9) * width;
        piece.may_rise = width > 1e-12;
      }
    }
    pieces_.push(piece);
  }

  const DistanceField& field_;
  const SparseGrid* grid_;  // null if the field is no uniform grid
  const Vector3d start_, displacement_;
  const double length_;
  std::vector<Sample> samples_;
  std::priority_queue<Piece> pieces_;
  LeastDistance best_{0.0, kInfinity, kInfinity, kInfinity};
  double best_error_ = 0.0;
};

/// The least distance in the leaves that the path crosses. `low` exceeds the band if the minimum is unknown, because
/// the path goes deeper than any leaf or never comes near the surface.
LeastDistance leastInLeaves(const AdaptiveGrid& grid, const Segment& segment) {
  GridWalk walk = walkThrough(grid, segment);
  const BallExit ball_exit(segment);
  LeastDistance least{0.0, kInfinity, kInfinity, kInfinity};
  Intervals no_intervals;
  while (walk.inside()) {
    const AdaptiveBlock block = grid.block(walk.cell());
    if (!block.leaf) {
      if (block.inside) return {0.0, kInfinity, kInfinity, kInfinity};
      passFree(block.low, block.side, emptySphere(grid, block, grid.shape().band), ball_exit, walk, no_intervals);
      continue;
    }
    const WalkedCell cell{block.low, block.side, walk.exit(block.low, block.low.array() + block.side)};
    const double t = walk.t(), t_exit = cell.t_exit;
    const std::array<double, 8> corners = grid.corners(block);
    const double lowest = *std::min_element(corners.begin(), corners.end()), error = grid.leafError(block);
    if (t_exit > t && (lowest - error < least.low || lowest + error < least.high || lowest < least.value)) {
      const CubicMinimum minimum = minimumOf(cubicAlong(corners, walk, cell, 0.0));
      least.low = std::min(least.low, minimum.value - error);
      least.high = std::min(least.high, minimum.value + error);
      if (minimum.value < least.value) {
        least.time = t + minimum.u * (t_exit - t);
        least.value = minimum.value;
      }
    }
    walk.advance();
  }
  return least;
}

/// Widens the bounds by how far the field's surface was moved, and by the rounding of coordinates and of the distance,
/// so that they hold in doubles too.
LeastDistance widened(LeastDistance least, double moved, const Segment& segment) {
  constexpr double kRoundings = 16.0;
  const double size = std::max(segment.start.lpNorm<Eigen::Infinity>(), segment.end.lpNorm<Eigen::Infinity>());
  const double rounding =
      kRoundings * std::numeric_limits<double>::epsilon() * (size + std::abs(least.low) + std::abs(least.high));
  least.low -= moved + rounding;
  least.high += moved + rounding;
  return least;
}

}  // namespace

LeastDistance leastDistance(const DistanceField& field, const Segment& segment) {
  requireWithinReach(segment, "least distance");
  if (const AdaptiveGrid* adaptive = FieldAccess::adaptive(field)) {
    const LeastDistance least = leastInLeaves(*adaptive, segment);
    if (least.low <= field.band()) return widened(least, field.moved(), segment);
  }
  return widened(LeastSearch(field, segment).run(), field.moved(), segment);
}

}  // namespace sdf_ccd
