#include "flat_piece.h"

#include <algorithm>
#include <utility>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

Vector2d leftOf(const Vector2d& direction) {
  return {-direction.y(), direction.x()};
}

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Height over longest edge.
double width(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double longest2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest2 > 0.0 ? cross(b - a, c - a) / longest2 : 0.0;
}

}  // namespace

FlatLine FlatLine::through(const Vector2d& point, const Vector2d& along) {
  const Vector2d normal = leftOf(along).normalized();
  return {normal, normal.dot(point)};
}

FlatPiece::FlatPiece(std::vector<FlatCorner> corners) : corners_(std::move(corners)) {
  sides_.reserve(corners_.size());
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vector2d& from = corners_[i].at;
    sides_.push_back(FlatLine::through(from, corners_[(i + 1) % corners_.size()].at - from));
  }
}

Vector2d FlatPiece::centroid() const {
  const Vector2d& origin = corners_[0].at;
  Vector2d sum = Vector2d::Zero(), mean = Vector2d::Zero();
  double area = 0.0;
  for (std::size_t i = 0; i < corners_.size(); ++i) mean += (corners_[i].at - origin) / double(corners_.size());
  for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
    const Vector2d a = corners_[i].at - origin, b = corners_[i + 1].at - origin;
    sum += cross(a, b) * (a + b) / 3.0;
    area += cross(a, b);
  }
  return origin + (area > 0.0 ? Vector2d(sum / area) : mean);
}

double FlatPiece::depth(const Vector2d& x) const {
  double least = kInfinity;
  for (const FlatLine& side : sides_) least = std::min(least, side.distance(x));
  return least;
}

double FlatPiece::chord(const Vector2d& from, const Vector2d& to, double border) const {
  double begin = 0.0, end = 1.0;
  for (const FlatLine& side : sides_) {
    const double at_from = side.distance(from) - border, at_to = side.distance(to) - border;
    if (at_from < 0.0 && at_to < 0.0) return -1.0;
    if (at_from >= 0.0 && at_to >= 0.0) continue;
    const double s = at_from / (at_from - at_to);
    (at_from < 0.0 ? begin : end) = at_from < 0.0 ? std::max(begin, s) : std::min(end, s);
  }
  return begin <= end ? (end - begin) * (to - from).norm() : -1.0;
}

std::vector<Vector2d> FlatPiece::common(const std::array<Vector2d, 3>& triangle, double border) const {
  std::vector<Vector2d> polygon(triangle.begin(), triangle.end()), clipped;
  for (const FlatLine& side : sides_) {
    clipped.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double at_a = side.distance(a) - border, at_b = side.distance(b) - border;
      if (at_a >= 0.0) clipped.push_back(a);
      if ((at_a < 0.0) != (at_b < 0.0)) clipped.push_back(a + at_a / (at_a - at_b) * (b - a));
    }
    polygon.swap(clipped);
  }
  return polygon;
}

std::array<FlatPiece, 2> FlatPiece::cut(const FlatLine& line, double snap) const {
  std::array<std::vector<FlatCorner>, 2> parts;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const FlatCorner &a = corners_[i], &b = corners_[(i + 1) % corners_.size()];
    const double at_a = line.distance(a.at), at_b = line.distance(b.at);
    if (at_a >= -snap) parts[0].push_back(a);
    if (at_a <= snap) parts[1].push_back(a);
    if (std::min(at_a, at_b) >= -snap || std::max(at_a, at_b) <= snap) continue;
    const double s = at_a / (at_a - at_b);
    const FlatCorner middle{a.at + s * (b.at - a.at), a.point + s * (b.point - a.point)};
    for (auto& part : parts) part.push_back(middle);
  }
  std::array<FlatPiece, 2> pieces;
  for (int k = 0; k < 2; ++k) {
    if (parts[k].size() >= 3) pieces[k] = FlatPiece(std::move(parts[k]));
  }
  return pieces;
}

std::vector<std::array<int, 3>> FlatPiece::triangles() const {
  const int count = static_cast<int>(corners_.size());
  int best = 0;
  double best_width = -1.0;
  for (int apex = 0; apex < count; ++apex) {
    double least = kInfinity;
    for (int i = 1; i + 1 < count; ++i) {
      least = std::min(least,
                       width(corners_[apex].at, corners_[(apex + i) % count].at, corners_[(apex + i + 1) % count].at));
    }
    if (least > best_width) {
      best_width = least;
      best = apex;
    }
  }
  std::vector<std::array<int, 3>> fan;
  for (int i = 1; i + 1 < count; ++i) fan.push_back({best, (best + i) % count, (best + i + 1) % count});
  return fan;
}

}  // namespace sdf_ccd
