#include "deepest_point.h"

#include <algorithm>
#include <vector>

namespace sdf_ccd::benchmark {
namespace {

/// A point of the segment, its depth [m], and its nearest triangle.
struct PathPoint {
  double t;
  Vector3d p;
  double depth;
  int triangle;
};

/// A piece of the segment, an upper bound of the depth in it [m], and the parameter at which to divide it.
struct Piece {
  PathPoint from, to;
  double upper_bound;
  double at;
};

class Search {
 public:
  Search(const precision::ExactSurface& mesh, const Segment& segment) : mesh_(mesh), segment_(segment) {}

  PathPoint evaluate(double t) const {
    const Vector3d p = segment_.start + t * (segment_.end - segment_.start);
    const SignedSurface::Nearest nearest = mesh_.surface().nearest(p);
    return {t, p, -nearest.distance, nearest.triangle};
  }

  Piece between(const PathPoint& a, const PathPoint& b) const {
    const double by_path = 0.5 * (a.depth + b.depth + (b.p - a.p).norm());
    const double a_from = distance(a, a.p), a_to = distance(a, b.p), b_from = distance(b, a.p), b_to = distance(b, b.p);
    double by_triangles = std::max(std::min(a_from, b_from), std::min(a_to, b_to)), share = 0.5;
    const double ahead_from = b_from - a_from, ahead_to = a_to - b_to;
    if (ahead_from > 0.0 && ahead_to > 0.0) {
      share = ahead_from / (ahead_from + ahead_to);
      by_triangles = std::max(by_triangles, a_from + share * (a_to - a_from));
      share = std::clamp(share, 0.1, 0.9);
    }
    if (by_path <= by_triangles) share = 0.5;
    return {a, b, std::min(by_path, by_triangles), a.t + share * (b.t - a.t)};
  }

 private:
  /// Distance [m] of p from the nearest triangle of another point.
  double distance(const PathPoint& point, const Vector3d& p) const {
    return (closestOnTriangle(cornersOf(mesh_.mesh(), point.triangle), p) - p).norm();
  }

  const precision::ExactSurface& mesh_;
  const Segment& segment_;
};

/// Largest depth found [m], by branch and bound. No point is deeper than this or `floor` by more than the tolerance,
/// unless the result exceeds max_depth, at which the search stops.
double deepest(const Search& search, double floor, double tolerance, double max_depth) {
  std::vector<Piece> pieces{search.between(search.evaluate(0.0), search.evaluate(1.0))};
  double found = std::max(pieces[0].from.depth, pieces[0].to.depth);
  while (!pieces.empty() && found <= max_depth) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    if (piece.upper_bound <= std::max(found, floor) + tolerance) continue;
    const PathPoint middle = search.evaluate(piece.at);
    found = std::max(found, middle.depth);
    pieces.push_back(search.between(piece.from, middle));
    pieces.push_back(search.between(middle, piece.to));
  }
  return found;
}

}  // namespace

DeepestPoint deepestOn(const precision::ExactSurface& mesh, const Segment& segment, const DepthOptions& options) {
  const Search search(mesh, segment);
  const double inside = deepest(search, 0.0, options.inside, options.max_depth);
  if (inside >= 0.0) return {inside, options.inside};
  return {std::max(inside, deepest(search, inside, options.outside, options.max_depth)), options.outside};
}

}  // namespace sdf_ccd::benchmark
