#include "measure_shell.h"

#include <cmath>

#include "nearest_point.h"
#include "surface_piece.h"

namespace sdf_ccd {
namespace {

SurfacePiece pieceOf(const TriangleMesh& mesh, const Vector3i& t) {
  return {{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}};
}

/// A piece with the point nearest to each of its corners.
struct LabelledPiece {
  SurfacePiece piece;
  std::array<std::int32_t, 3> nearest;
};

/// Halves the longest edge, opposite `corner`; `middle` is its midpoint with its nearest point.
std::pair<LabelledPiece, LabelledPiece> halves(const LabelledPiece& whole, int corner, const Vector3d& middle,
                                               std::int32_t nearest) {
  std::pair<LabelledPiece, LabelledPiece> result{whole, whole};
  const int next = (corner + 1) % 3, last = (corner + 2) % 3;
  result.first.piece.corners[last] = middle;
  result.first.nearest[last] = nearest;
  result.second.piece.corners[next] = middle;
  result.second.nearest[next] = nearest;
  return result;
}

Vector3d middleOpposite(const SurfacePiece& piece, int corner) {
  return (piece.corners[(corner + 1) % 3] + piece.corners[(corner + 2) % 3]) / 2;
}

}  // namespace

double coveringRadius(const TriangleMesh& mesh, const PointShell& shell) {
  const NearestPoint points(shell);
  const Vector3d any = Vector3d::Zero();
  constexpr double kSlack2 = 1.01 * 1.01;
  const double rounding = 1e-12 * (boundingBox(mesh).min().cwiseAbs().maxCoeff() + boundingBox(mesh).sizes().norm());

  // First a lower bound from places of every triangle: the better it is, the fewer pieces need halving.
  double reached2 = rounding * rounding;
  for (const Vector3i& t : mesh.triangles) {
    reached2 = std::max(reached2, points.find(pieceOf(mesh, t).centroid(), any).distance2);
  }
  std::vector<std::int32_t> nearest(mesh.vertices.size());
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    const NearestPoint::Hit hit = points.find(mesh.vertices[v], any);
    nearest[v] = hit.index;
    reached2 = std::max(reached2, hit.distance2);
  }

  double bound2 = reached2;
  std::vector<LabelledPiece> stack;
  for (const Vector3i& t : mesh.triangles) {
    stack.push_back({pieceOf(mesh, t), {nearest[t[0]], nearest[t[1]], nearest[t[2]]}});
    while (!stack.empty()) {
      const LabelledPiece current = stack.back();
      stack.pop_back();
      double upper2 = current.piece.farthest2(shell.points[current.nearest[0]]);
      for (int i = 1; i < 3; ++i) {
        upper2 = std::min(upper2, current.piece.farthest2(shell.points[current.nearest[i]]));
      }
      if (upper2 <= kSlack2 * reached2) {
        bound2 = std::max(bound2, upper2);
        continue;
      }
      const NearestPoint::Hit center = points.find(current.piece.centroid(), any);
      reached2 = std::max(reached2, center.distance2);
      upper2 = std::min(upper2, current.piece.farthest2(shell.points[center.index]));
      if (upper2 <= kSlack2 * reached2) {
        bound2 = std::max(bound2, upper2);
        continue;
      }
      const int corner = current.piece.longestEdge().first;
      const Vector3d middle = middleOpposite(current.piece, corner);
      const NearestPoint::Hit hit = points.find(middle, any);
      reached2 = std::max(reached2, hit.distance2);
      const auto [first, second] = halves(current, corner, middle, hit.index);
      stack.push_back(first);
      stack.push_back(second);
    }
  }
  return std::sqrt(bound2) * (1 + 1e-14);
}

std::vector<double> nearestAreas(const TriangleMesh& mesh, const PointShell& shell, double resolution) {
  const NearestPoint points(shell);
  std::vector<double> areas(shell.size(), 0.0);
  std::vector<std::pair<LabelledPiece, double>> stack;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3d normal = areaNormal(mesh, static_cast<int>(i));
    // Among the points of one fixed set, the places nearest to a point are convex: equal corners settle a piece.
    Vector3d facing = normal;
    const auto nearest = [&](const Vector3d& p) { return points.find(p, facing).index; };
    LabelledPiece whole{pieceOf(mesh, mesh.triangles[i]), {}};
    if (nearest(whole.piece.corners[0]) < 0) facing.setZero();
    for (int corner = 0; corner < 3; ++corner) whole.nearest[corner] = nearest(whole.piece.corners[corner]);
    stack.emplace_back(whole, normal.norm() / 2);
    while (!stack.empty()) {
      const auto [current, area] = stack.back();
      stack.pop_back();
      const auto [corner, length2] = current.piece.longestEdge();
      const auto& labels = current.nearest;
      if ((labels[0] == labels[1] && labels[1] == labels[2]) || length2 <= resolution * resolution) {
        for (const std::int32_t label : labels) areas[label] += area / 3;
        continue;
      }
      const Vector3d middle = middleOpposite(current.piece, corner);
      const auto [first, second] = halves(current, corner, middle, nearest(middle));
      stack.emplace_back(first, area / 2);
      stack.emplace_back(second, area / 2);
    }
  }
  return areas;
}

}  // namespace sdf_ccd
