#include "triangle_cutter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/cancel_point.h"

namespace sdf_ccd {
namespace {

/// For planes at a smaller angle [rad], faces that are meant to coincide among them, their distance matters, not the
/// line in which they meet.
constexpr double kShallow = 1e-5;

/// How another triangle affects a part.
struct Relation {
  enum Kind { kNone, kCut, kLayer, kUnclear };
  Kind kind = kNone;
  bool again = false;  ///< it may still matter after the cut
  FlatLine line{};
  double length = 0.0;    ///< of the cut
  bool doubtful = false;  ///< the front and back of the part alone may not decide the side
};

}  // namespace

class TriangleCutter::Task {
  /// Another triangle in the coordinates of the plane of the one that is cut.
  struct Other {
    enum Kind {
      kApart,    ///< does not reach the plane
      kCrosses,  ///< meets it in a segment
      kShallow,  ///< nearly parallel to it
      kUnclear,  ///< so thin that it has no certain plane, and nearly parallel
    };
    Kind kind = kApart;
    int triangle = -1;
    std::array<Vector2d, 3> at;
    std::array<double, 3> height;
    Vector2d from, to;  ///< of the segment
  };

 public:
  Task(const TriangleCutter& cutter, int triangle, const Cost& most)
      : cutter_(cutter), triangle_(triangle), most_(most) {
    const Vector3i& t = cutter.mesh_.triangles[triangle];
    for (int k = 0; k < 3; ++k) corners_[k] = cutter.mesh_.vertices[t[k]];
    normal_ = areaNormal(cutter.mesh_, triangle).normalized();
    u_ = (corners_[1] - corners_[0]).normalized();
    v_ = normal_.cross(u_);
  }

  Result run(const std::vector<int>& triangles) {
    for (const int id : triangles) {
      const Other other = seen(id);
      if (other.kind != Other::kApart) others_.push_back(other);
    }
    std::vector<int> all(others_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    std::vector<FlatCorner> whole;
    for (int k = 0; k < 3; ++k) {
      whole.push_back({flat(corners_[k]), corners_[k], cutter_.mesh_.triangles[triangle_][k]});
    }
    std::vector<SurfacePart> parts = divide(FlatPiece(std::move(whole)), std::move(all));
    if (costs_too_much_) return {{}, cost_};
    for (SurfacePart& part : parts) part.tells_sides = !doubtful_;
    return {std::move(parts), cost_};
  }

 private:
  Vector2d flat(const Vector3d& p) const { return {u_.dot(p - corners_[0]), v_.dot(p - corners_[0])}; }

  static double heightAt(const Other& other, const Vector2d& x) {
    const Vector2d u = other.at[1] - other.at[0], v = other.at[2] - other.at[0], w = x - other.at[0];
    const double area = u.x() * v.y() - u.y() * v.x();
    const double s = (w.x() * v.y() - w.y() * v.x()) / area, t = (u.x() * w.y() - u.y() * w.x()) / area;
    return other.height[0] + s * (other.height[1] - other.height[0]) + t * (other.height[2] - other.height[0]);
  }

  Other seen(int id) const {
    const SurfaceTolerance& tolerance = cutter_.tolerance_;
    Other other;
    other.triangle = id;
    const Vector3i& t = cutter_.mesh_.triangles[id];
    double low = 0.0, high = 0.0, longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vector3d& p = cutter_.mesh_.vertices[t[k]];
      other.at[k] = flat(p);
      other.height[k] = normal_.dot(p - corners_[0]);
      low = k == 0 ? other.height[k] : std::min(low, other.height[k]);
      high = k == 0 ? other.height[k] : std::max(high, other.height[k]);
      longest = std::max(longest, (cutter_.mesh_.vertices[t[(k + 1) % 3]] - p).norm());
    }
    if (low > tolerance.layer || high < -tolerance.layer) return other;
    const Vector3d area_normal = areaNormal(cutter_.mesh_, id);
    const bool thin = area_normal.norm() <= tolerance.border * longest;
    if (!thin && normal_.cross(area_normal).norm() < kShallow * area_normal.norm()) {
      other.kind = Other::kShallow;
      return other;
    }
    if (thin && high - low < kShallow * longest) {
      // A thin strip within the plane has no sides, and its neighbours have edges there, too.
      other.kind = high <= tolerance.layer && low >= -tolerance.layer ? Other::kApart : Other::kUnclear;
      return other;
    }
    setSegment(other);
    return other;
  }

  /// Sets the segment in which the other triangle meets the plane.
  void setSegment(Other& other) const {
    std::array<int, 3> sign;
    for (int k = 0; k < 3; ++k) {
      const double h = other.height[k];
      sign[k] = std::abs(h) <= cutter_.tolerance_.rounding ? 0 : h > 0.0 ? 1 : -1;
    }
    int count = 0;
    const auto add = [&](const Vector2d& p) {
      if (count < 2) (count == 0 ? other.from : other.to) = p;
      ++count;
    };
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if (sign[k] == 0) add(other.at[k]);
      if (sign[k] * sign[next] < 0) {
        const double s = other.height[k] / (other.height[k] - other.height[next]);
        add(other.at[k] + s * (other.at[next] - other.at[k]));
      }
    }
    // A triangle with only a corner on the plane does not cross it. If the surface does, triangles around it show that.
    if (count >= 2) other.kind = Other::kCrosses;
  }

  Relation relation(const FlatPiece& piece, const Other& other) const {
    switch (other.kind) {
      case Other::kCrosses:
        return segmentRelation(piece, other.from, other.to);
      case Other::kShallow:
        return shallowRelation(piece, other);
      default:
        return {piece.common(other.at, 0.0).empty() ? Relation::kNone : Relation::kUnclear, true};
    }
  }

  Relation segmentRelation(const FlatPiece& piece, const Vector2d& from, const Vector2d& to) const {
    Relation found;
    found.length = piece.chord(from, to, cutter_.tolerance_.border);
    if (found.length < 0.0) return found;
    found.kind = Relation::kCut;
    Vector2d along = to - from;
    // The direction of a cut through a single point is arbitrary.
    if (along.norm() <= 0.01 * cutter_.tolerance_.border) along = piece.centroid() - from;
    if (along.norm() <= 0.01 * cutter_.tolerance_.border) along = Vector2d::UnitX();
    found.line = FlatLine::through(from, along);
    return found;
  }

  /// Within a layer of the part, the other triangle is taken as one with it; farther away, it is separate.
  Relation shallowRelation(const FlatPiece& piece, const Other& other) const {
    const double layer = cutter_.tolerance_.layer;
    const std::vector<Vector2d> common = piece.common(other.at, cutter_.tolerance_.border);
    if (common.empty()) return {};
    std::vector<double> heights;
    for (const Vector2d& x : common) heights.push_back(heightAt(other, x));
    const double low = *std::min_element(heights.begin(), heights.end());
    const double high = *std::max_element(heights.begin(), heights.end());
    // Unless it is a layer everywhere, as seen from both, one may be left out and the other kept.
    const bool doubtful = (low > 0.05 * layer || high < -0.05 * layer || high - low > 0.05 * layer) &&
                          low < 2.0 * layer && high > -2.0 * layer;
    if (low >= 0.9 * layer || high <= -0.9 * layer) return {Relation::kNone, false, {}, 0.0, doubtful};
    if (low >= -1.5 * layer && high <= 1.5 * layer) {
      Relation longest{Relation::kLayer, true};
      for (int k = 0; k < 3; ++k) {
        const Relation edge = segmentRelation(piece, other.at[k], other.at[(k + 1) % 3]);
        if (edge.kind == Relation::kCut && (longest.kind == Relation::kLayer || edge.length > longest.length)) {
          longest = edge;
        }
      }
      longest.again = true;
      longest.doubtful = doubtful;
      return longest;
    }
    const double level = high > 1.5 * layer ? layer : -layer;
    std::vector<Vector2d> ends;
    for (std::size_t i = 0; i < common.size(); ++i) {
      const std::size_t next = (i + 1) % common.size();
      const double a = heights[i] - level, b = heights[next] - level;
      if ((a < 0.0) != (b < 0.0)) ends.push_back(common[i] + a / (a - b) * (common[next] - common[i]));
    }
    if (ends.size() < 2) return {Relation::kUnclear, true};
    Relation found = segmentRelation(piece, ends[0], ends[1]);
    if (found.kind != Relation::kCut) return {Relation::kUnclear, true};
    found.again = true;
    found.doubtful = true;
    return found;
  }

  /// @param depth  of the recursion: a piece that is cut so often is left unknown, as the stack is bounded.
  std::vector<SurfacePart> divide(const FlatPiece& piece, std::vector<int> near, int depth = 0) {
    constexpr int kMaxDepth = 1000;
    cancel_.check();
    if (depth == kMaxDepth) return {{piece, Sides::kUnknown}};
    cost_.steps += near.size() + 1;
    costs_too_much_ = costs_too_much_ || cost_.steps > most_.steps || cost_.visits > most_.visits;
    if (costs_too_much_) return {};
    Relation longest;
    int cutting = -1;
    bool unclear = false;
    std::vector<int> layers;
    std::size_t kept = 0;
    for (const int i : near) {
      const Relation found = relation(piece, others_[i]);
      doubtful_ = doubtful_ || found.doubtful;
      if (found.kind == Relation::kNone) continue;
      near[kept++] = i;
      unclear = unclear || found.kind == Relation::kUnclear;
      if (found.kind == Relation::kLayer) layers.push_back(others_[i].triangle);
      if (found.kind == Relation::kCut && (cutting < 0 || found.length > longest.length)) {
        longest = found;
        cutting = i;
      }
    }
    near.resize(kept);
    if (unclear) return {{piece, Sides::kUnknown}};
    if (cutting < 0) return {{piece, sides(piece, layers)}};
    if (!longest.again) near.erase(std::find(near.begin(), near.end(), cutting));
    const auto halves = piece.cut(longest.line, 0.01 * cutter_.tolerance_.border);
    if (halves[0].corners().empty() || halves[1].corners().empty()) return {{piece, Sides::kUnknown}};
    std::vector<SurfacePart> parts = divide(halves[0], near, depth + 1);
    std::vector<SurfacePart> others = divide(halves[1], std::move(near), depth + 1);
    if (parts.size() == 1 && others.size() == 1 && parts[0].sides == others[0].sides) {
      return {{piece, parts[0].sides}};
    }
    parts.insert(parts.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
    return parts;
  }

  Sides sides(const FlatPiece& piece, const std::vector<int>& layers) {
    const Vector2d middle = piece.centroid();
    const double clearance = piece.depth(middle);
    if (clearance <= 8.0 * cutter_.tolerance_.border) return Sides::kUnknown;
    const Vector3d point = corners_[0] + middle.x() * u_ + middle.y() * v_;
    const Sides found = cutter_.test_.at({point, normal_, clearance, triangle_}, layers, &cost_.visits);
    costs_too_much_ = cost_.visits > most_.visits;
    // Faces that lie on each other all have the same sides, in either orientation. The first one is kept.
    const bool has_sides = found == Sides::kOutward || found == Sides::kInward;
    const bool is_first = layers.empty() || layers.front() > triangle_;
    return has_sides && !is_first ? Sides::kDuplicate : found;
  }

  const CancelPoint cancel_;
  const TriangleCutter& cutter_;
  int triangle_;
  std::array<Vector3d, 3> corners_;
  Vector3d normal_, u_, v_;
  std::vector<Other> others_;  ///< ascending
  Cost most_, cost_;
  bool costs_too_much_ = false;
  bool doubtful_ = false;  ///< another triangle is nearly a layer
};

TriangleCutter::Result TriangleCutter::parts(int triangle, const std::vector<int>& others, const Cost& most) const {
  return Task(*this, triangle, most).run(others);
}

}  // namespace sdf_ccd
