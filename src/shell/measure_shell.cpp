#include "measure_shell.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "common/cancel_point.h"
#include "common/parallel_for.h"
#include "piece_walk.h"

namespace sdf_ccd {
namespace {

/// Triangles per task. Fixed, so that results do not depend on the number of threads.
constexpr std::size_t kChunk = 64;

std::size_t chunks(const TriangleMesh& mesh) {
  return (mesh.triangles.size() + kChunk - 1) / kChunk;
}

/// Calls work(chunk, triangle) for all triangles; chunks in parallel.
template <typename Work>
void forEachTriangle(const TriangleMesh& mesh, const NearestPoint& nearest, double scale, Work work) {
  const CancelPoint cancel;
  parallelFor(std::size_t{0}, chunks(mesh), [&](std::size_t chunk) {
    PieceWalk pieces(nearest, scale, cancel);
    const std::size_t last = std::min(mesh.triangles.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < last; ++i) work(chunk, static_cast<int>(i), pieces);
  });
}

using Shares = std::vector<std::pair<std::int32_t, double>>;  // of points, in the area [m²]

/// Adds the cells of one triangle to its points' shares. @return the largest distance of a cell from its point,
/// squared.
double divide(const SurfacePiece& whole, const Vector3d& facing, PieceWalk& pieces, Shares& shares) {
  double farthest2 = 0.0;
  const auto belongsToOne = [&](const ContestedPiece& contested) {
    if (contested.size() > 1) return false;
    const Candidate& owner = *contested.begin;
    shares.emplace_back(owner.index, contested.piece.area());
    farthest2 = std::max(farthest2, contested.piece.farthest2(owner.point));
    return true;
  };
  pieces.walk(whole, facing, belongsToOne, [&](const ContestedPiece& contested) {
    const std::size_t first = shares.size();
    double sum = 0;
    forEachCell(contested, [&](const Candidate& candidate, const CellPolygon& cell) {
      shares.emplace_back(candidate.index, cell.area());
      farthest2 = std::max(farthest2, cell.farthest2(candidate.point));
      sum += shares.back().second;
    });
    // Up to rounding, the cells fill the piece. Normalised, so that rounding does not accumulate.
    const double area = contested.piece.area();
    for (std::size_t share = first; share < shares.size(); ++share) {
      shares[share].second *= sum > 0 ? area / sum : 0;
    }
    if (!(sum > 0)) shares.emplace_back(contested.begin->index, area);
  });
  return farthest2;
}

void raise(double value, std::atomic<double>& largest) {
  double known = largest.load(std::memory_order_relaxed);
  while (value > known && !largest.compare_exchange_weak(known, value, std::memory_order_relaxed)) {
  }
}

/// The square of the covering radius.
/// @param at_most2  per triangle, an upper bound of it. Few triangles' are above the radius, and only these are walked.
double coveringRadius2(const TriangleMesh& mesh, const NearestPoint& nearest, double scale,
                       const std::vector<double>& at_most2) {
  const Vector3d any = Vector3d::Zero();
  std::vector<double> reached2(chunks(mesh), 0.0);
  // First one location per triangle: the better the lower bound of the radius, the fewer pieces must be cut.
  forEachTriangle(mesh, nearest, scale, [&](std::size_t chunk, int i, PieceWalk&) {
    if (at_most2[static_cast<std::size_t>(i)] <= reached2[chunk]) return;
    reached2[chunk] = std::max(reached2[chunk], nearest.find(centroid(cornersOf(mesh, i)), any).distance2);
  });
  // Shared by all tasks, in any order: a task skips only pieces that are covered by a radius already found.
  std::atomic<double> bound2{*std::max_element(reached2.begin(), reached2.end())};
  const auto isBelow = [&](const ContestedPiece& contested) {
    const double known2 = bound2.load(std::memory_order_relaxed);
    return std::any_of(contested.begin, contested.end, [&](const Candidate& candidate) {
      return contested.piece.farthest2(candidate.point) <= known2;
    });
  };
  forEachTriangle(mesh, nearest, scale, [&](std::size_t, int i, PieceWalk& pieces) {
    if (at_most2[static_cast<std::size_t>(i)] <= bound2.load(std::memory_order_relaxed)) return;
    pieces.walk(SurfacePiece::of(mesh, i), any, isBelow, [&](const ContestedPiece& contested) {
      forEachCell(contested, [&](const Candidate& candidate, const CellPolygon& cell) {
        raise(cell.farthest2(candidate.point), bound2);
      });
    });
  });
  return bound2.load();
}

}  // namespace

ShellMeasures measureShell(const TriangleMesh& mesh, const SampledPoints& shell, double scale) {
  const NearestPoint nearest(shell);
  std::vector<Shares> shares(chunks(mesh));
  std::vector<double> farthest2(mesh.triangles.size());
  forEachTriangle(mesh, nearest, scale, [&](std::size_t chunk, int i, PieceWalk& pieces) {
    const SurfacePiece whole = SurfacePiece::of(mesh, i);
    Vector3d facing = areaNormal(mesh, i);
    if (nearest.find(whole.corners[0], facing).index < 0) facing.setZero();
    farthest2[static_cast<std::size_t>(i)] = divide(whole, facing, pieces, shares[chunk]);
  });
  ShellMeasures measures;
  measures.areas.assign(shell.size(), 0.0);
  for (const Shares& chunk : shares) {
    for (const auto& [index, area] : chunk) measures.areas[index] += area;
  }
  const AlignedBox3d box = boundingBox(mesh);
  const double rounding = 1e-14 * (box.min().cwiseAbs().maxCoeff() + box.sizes().norm()) + 1e-9 * scale;
  measures.covering_radius = std::sqrt(coveringRadius2(mesh, nearest, scale, farthest2)) * (1 + 1e-9) + rounding;
  return measures;
}

}  // namespace sdf_ccd
