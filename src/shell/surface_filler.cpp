#include "surface_filler.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "common/number_text.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {
namespace {

/// Uniform in [0, 1), the same with every standard library.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Normals weighted by the angle of each triangle at the vertex (Thürmer & Wüthrich 1998).
std::vector<Vector3d> vertexNormals(const TriangleMesh& mesh, const std::vector<Vector3d>& triangle_normals) {
  std::vector<Vector3d> sums(mesh.vertices.size(), Vector3d::Zero());
  std::vector<Vector3d> fallback(mesh.vertices.size(), Vector3d::UnitZ());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    if (triangle_normals[i].isZero()) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const Vector3d& p = mesh.vertices[t[corner]];
      const Vector3d u = mesh.vertices[t[(corner + 1) % 3]] - p, v = mesh.vertices[t[(corner + 2) % 3]] - p;
      sums[t[corner]] += triangle_normals[i] * std::atan2(u.cross(v).norm(), u.dot(v));
      fallback[t[corner]] = triangle_normals[i];
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double norm = sums[v].norm();
    sums[v] = norm > 1e-6 ? Vector3d(sums[v] / norm) : fallback[v];  // the normals of a sheet's two sides cancel
  }
  return sums;
}

/// The parts of a segment, by arc length, that are within a radius of given points.
class CoveredParts {
 public:
  CoveredParts(const SurfaceEdge& edge, double radius)
      : from_(edge.from), length_((edge.to - edge.from).norm()), radius_(radius) {
    if (length_ > 0.0) along_ = (edge.to - edge.from) / length_;
  }

  double length() const { return length_; }
  Vector3d at(double s) const { return from_ + s * along_; }

  void add(const Vector3d& p) {
    const double s = along_.dot(p - from_);
    const double half2 = radius_ * radius_ - (p - at(s)).squaredNorm();
    if (half2 > 0.0) parts_.emplace_back(s - std::sqrt(half2), s + std::sqrt(half2));
  }

  /// Calls visit(begin, end) for each part that is not covered.
  template <typename Visit>
  void forEachGap(Visit visit) {
    std::sort(parts_.begin(), parts_.end());
    double reached = 0.0;
    for (const auto& [begin, end] : parts_) {
      if (begin > reached) visit(reached, std::min(begin, length_));
      reached = std::max(reached, end);
      if (reached >= length_) return;
    }
    visit(reached, length_);
  }

 private:
  Vector3d from_, along_ = Vector3d::Zero();
  double length_, radius_;
  std::vector<std::pair<double, double>> parts_;
};

}  // namespace

SurfaceFiller::SurfaceFiller(const TriangleMesh& mesh, const ShellOptions& options)
    : mesh_(mesh), options_(options), triangle_normals_(triangleNormals(mesh)), grid_(options.spacing) {}

void SurfaceFiller::refuse() const {
  std::string spacing = numberText(options_.spacing) + " m";
  if (options_.edge_gap > 0.0) spacing += " (" + numberText(options_.edge_gap) + " m for edges)";
  throw std::length_error("a point every " + spacing + " needs more than " + std::to_string(options_.max_points) +
                          " points");
}

void SurfaceFiller::add(const Vector3d& p, const Vector3d& normal) {
  if (shell_.size() >= options_.max_points) refuse();
  shell_.points.push_back(p);
  shell_.normals.push_back(normal.cast<float>());
  grid_.insert(p);
}

bool SurfaceFiller::isCovered(const Vector3d& p, const Vector3d& normal) const {
  const double spacing2 = options_.spacing * options_.spacing;
  return grid_.anyNear(p, [&](std::int32_t i) {
    return (shell_.points[i] - p).squaredNorm() < spacing2 && shell_.normals[i].cast<double>().dot(normal) >= 0;
  });
}

void SurfaceFiller::addVertices() {
  const std::vector<Vector3d> normals = vertexNormals(mesh_, triangle_normals_);
  const double thinning = options_.vertex_spacing;
  if (thinning == 0) {
    for (std::size_t v = 0; v < normals.size(); ++v) add(mesh_.vertices[v], normals[v]);
    return;
  }
  PointGrid kept(thinning);
  std::vector<Vector3d> points;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    cancel_.check();
    const Vector3d& p = mesh_.vertices[v];
    if (kept.anyNear(p, [&](std::int32_t i) { return (points[i] - p).squaredNorm() < thinning * thinning; })) continue;
    kept.insert(p);
    points.push_back(p);
    add(p, normals[v]);
  }
}

void SurfaceFiller::fillEdges(const std::vector<SurfaceEdge>& edges, double edge_radius) {
  if (edges.empty()) return;
  const double radius = edge_radius * (1.0 - 1e-9);  // neighbouring parts must overlap in spite of rounding
  PointGrid near(1.2 * radius);                      // queries every radius find all points within a radius of an edge
  for (const Vector3d& p : shell_.points) near.insert(p);
  for (const SurfaceEdge& edge : edges) {
    cancel_.check();
    CoveredParts covered(edge, radius);
    const double steps = std::floor(covered.length() / radius);
    if (steps > static_cast<double>(options_.max_points)) refuse();
    for (std::int64_t k = 0; k <= static_cast<std::int64_t>(steps); ++k) {
      near.anyNear(covered.at(std::min((double(k) + 0.5) * radius, covered.length())), [&](std::int32_t i) {
        covered.add(shell_.points[i]);
        return false;
      });
    }
    covered.forEachGap([&](double begin, double end) {
      const double count = std::max(1.0, std::ceil((end - begin) / (2.0 * radius)));
      for (std::int64_t k = 0; k < static_cast<std::int64_t>(count); ++k) {
        add(covered.at(begin + (end - begin) * (double(k) + 0.5) / count), edge.normal);
        near.insert(shell_.points.back());
      }
    });
  }
}

void SurfaceFiller::throwDarts() {
  std::vector<double> area_below;
  double area = 0;
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    area += areaNormal(mesh_, static_cast<int>(i)).norm() / 2;
    area_below.push_back(area);
  }
  // A full Poisson-disk sampling has about 0.7 points per spacing²; ten darts per point leave few gaps.
  const auto darts = static_cast<std::int64_t>(std::ceil(7 * area / (options_.spacing * options_.spacing)));
  std::mt19937_64 random(options_.seed);
  for (std::int64_t dart = 0; dart < darts; ++dart) {
    cancel_.check();
    const double choice = uniform(random) * area, u = std::sqrt(uniform(random)), v = uniform(random);
    const auto chosen = std::upper_bound(area_below.begin(), area_below.end(), choice);
    const std::size_t i = std::min<std::size_t>(chosen - area_below.begin(), area_below.size() - 1);
    const Vector3i& t = mesh_.triangles[i];
    // Uniform in the triangle: Turk 1990, Generating random points in triangles.
    const Vector3d p = mesh_.vertices[t[0]] + u * (1 - v) * (mesh_.vertices[t[1]] - mesh_.vertices[t[0]]) +
                       u * v * (mesh_.vertices[t[2]] - mesh_.vertices[t[0]]);
    if (!isCovered(p, triangle_normals_[i])) add(p, triangle_normals_[i]);
  }
}

void SurfaceFiller::fillGaps() {
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    forEachCompactPiece(SurfacePiece::of(mesh_, static_cast<int>(i)), options_.spacing,
                        [&](const SurfacePiece& piece) { fillGaps(piece, triangle_normals_[i]); });
  }
}

void SurfaceFiller::gather(OpenPiece& open, const Vector3d& center, const Vector3d& normal) {
  const double reach = (1 + 1e-9) * (options_.spacing + std::sqrt(open.piece.farthest2(center)));
  const auto isNear = [&](const Vector3d& p) { return (p - center).squaredNorm() <= reach * reach; };
  const auto offer = [&](std::size_t i) {
    const Vector3d& p = shell_.points[i];
    if (isNear(p) && shell_.normals[i].cast<double>().dot(normal) >= 0) candidates_.push_back(p);
  };
  const std::size_t begin = open.end;
  if (open.begin == open.end) {
    grid_.anyWithin(center, reach, [&](std::int32_t i) {
      offer(static_cast<std::size_t>(i));
      return false;
    });
  } else {
    candidates_.resize(begin + (open.end - open.begin));
    auto kept = candidates_.begin() + std::ptrdiff_t(begin);
    for (std::size_t i = open.begin; i < open.end; ++i) {
      *kept = candidates_[i];
      kept += isNear(*kept) ? 1 : 0;
    }
    candidates_.erase(kept, candidates_.end());
    for (std::size_t i = open.known; i < shell_.size(); ++i) offer(i);
  }
  open.begin = begin;
  open.end = candidates_.size();
  open.known = shell_.size();
}

void SurfaceFiller::fillGaps(const SurfacePiece& whole, const Vector3d& normal) {
  const double spacing2 = options_.spacing * options_.spacing;
  // A piece this small that no single point covers lies on the rim of several balls; a point at its centre covers it.
  constexpr double kSmallest2 = 0.05 * 0.05;
  // To search once for a larger piece and distribute its points is cheaper than to search for each small one.
  constexpr double kGather2 = 3 * 3;
  pieces_.assign(1, {whole, 0, 0, 0});
  while (!pieces_.empty()) {
    cancel_.check();
    OpenPiece open = pieces_.back();
    pieces_.pop_back();
    // Candidates beyond this piece's belong to finished pieces; those before, to the pieces that contain this one.
    candidates_.resize(open.end);
    const double length2 = open.piece.longestEdge().second;
    const Vector3d center = centroid(open.piece.corners);
    if (length2 <= kGather2 * spacing2) gather(open, center, normal);
    if (length2 <= 4 * spacing2) {
      const auto any = [&](auto covers) {
        return std::any_of(candidates_.begin() + std::ptrdiff_t(open.begin), candidates_.end(), covers);
      };
      if (any([&](const Vector3d& p) { return open.piece.farthest2(p) <= spacing2; })) continue;
      const bool is_covered = any([&](const Vector3d& p) { return (p - center).squaredNorm() < spacing2; });
      if (length2 <= kSmallest2 * spacing2 || !is_covered) {
        add(center, normal.isZero() ? Vector3d::UnitZ() : normal);
        pieces_.push_back(open);
        continue;
      }
    }
    const auto [first, second] = open.piece.halves();
    pieces_.push_back({first, open.begin, open.end, open.known});
    pieces_.push_back({second, open.begin, open.end, open.known});
  }
}

}  // namespace sdf_ccd
