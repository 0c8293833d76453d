#include "measure_shell.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "common/parallel_for.h"
#include "piece_walk.h"

namespace sdf_ccd {
namespace {

/// Triangles per task. Fixed, so that results do not depend on the number of threads.
constexpr std::size_t kChunk = 64;

/// Calls work(chunk, first triangle, last triangle) for all chunks, in parallel.
template <typename Work>
void forEachChunk(const TriangleMesh& mesh, Work work) {
  const std::size_t count = mesh.triangles.size();
  parallelFor(std::size_t{0}, (count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    work(chunk, static_cast<int>(chunk * kChunk), static_cast<int>(std::min(count, (chunk + 1) * kChunk)));
  });
}

std::size_t chunks(const TriangleMesh& mesh) {
  return (mesh.triangles.size() + kChunk - 1) / kChunk;
}

void raise(double value, std::atomic<double>& largest) {
  double known = largest.load(std::memory_order_relaxed);
  while (value > known && !largest.compare_exchange_weak(known, value, std::memory_order_relaxed)) {
  }
}

/// Adds the cells of one triangle to its points' areas.
using Shares = std::vector<std::pair<std::int32_t, double>>;

void divideErrorBudget(const SurfacePiece& whole, const Vector3d& facing, PieceWalk& pieces, Shares& shares) {
  const auto belongsToOne = [&](const ContestedPiece& contested) {
    if (contested.size() > 1) return false;
    shares.emplace_back(contested.begin->index, contested.piece.area());
    return true;
  };
  pieces.walk(whole, facing, belongsToOne, [&](const ContestedPiece& contested) {
    const std::size_t first = shares.size();
    double sum = 0;
    forEachCell(contested, [&](const Candidate& candidate, const CellPolygon& cell) {
      shares.emplace_back(candidate.index, cell.area());
      sum += shares.back().second;
    });
    // Up to rounding, the cells fill the piece. Normalised, so that rounding does not accumulate.
    const double area = contested.piece.area();
    for (std::size_t share = first; share < shares.size(); ++share) {
      shares[share].second *= sum > 0 ? area / sum : 0;
    }
    if (!(sum > 0)) shares.emplace_back(contested.begin->index, area);
  });
}

}  // namespace

double coveringRadius(const TriangleMesh& mesh, const PointShell& shell, double scale) {
  const NearestPoint nearest(shell);
  const CancelPoint cancel;
  const Vector3d any = Vector3d::Zero();
  std::vector<double> reached2(chunks(mesh), 0.0);
  // First one location per triangle: the better the lower bound of the radius, the fewer pieces must be cut.
  forEachChunk(mesh, [&](std::size_t chunk, int first, int last) {
    for (int i = first; i < last; ++i) {
      reached2[chunk] = std::max(reached2[chunk], nearest.find(SurfacePiece::of(mesh, i).centroid(), any).distance2);
    }
  });
  // Shared by all tasks, in any order: a task skips only pieces that are covered by a radius already found.
  std::atomic<double> bound2{*std::max_element(reached2.begin(), reached2.end())};
  forEachChunk(mesh, [&](std::size_t, int first, int last) {
    const auto isBelow = [&](const ContestedPiece& contested) {
      const double known2 = bound2.load(std::memory_order_relaxed);
      return std::any_of(contested.begin, contested.end, [&](const Candidate& candidate) {
        return contested.piece.farthest2(candidate.point) <= known2;
      });
    };
    PieceWalk pieces(nearest, scale, cancel);
    for (int i = first; i < last; ++i) {
      pieces.walk(SurfacePiece::of(mesh, i), any, isBelow, [&](const ContestedPiece& contested) {
        forEachCell(contested, [&](const Candidate& candidate, const CellPolygon& cell) {
          raise(cell.farthest2(candidate.point), bound2);
        });
      });
    }
  });
  const AlignedBox3d box = boundingBox(mesh);
  const double rounding = 1e-14 * (box.min().cwiseAbs().maxCoeff() + box.sizes().norm()) + 1e-9 * scale;
  return std::sqrt(bound2.load()) * (1 + 1e-9) + rounding;
}

std::vector<double> nearestAreas(const TriangleMesh& mesh, const PointShell& shell, double scale) {
  const NearestPoint nearest(shell);
  const CancelPoint cancel;
  std::vector<Shares> shares(chunks(mesh));
  forEachChunk(mesh, [&](std::size_t chunk, int first, int last) {
    PieceWalk pieces(nearest, scale, cancel);
    for (int i = first; i < last; ++i) {
      const SurfacePiece whole = SurfacePiece::of(mesh, i);
      Vector3d facing = areaNormal(mesh, i);
      if (nearest.find(whole.corners[0], facing).index < 0) facing.setZero();
      divideErrorBudget(whole, facing, pieces, shares[chunk]);
    }
  });
  std::vector<double> areas(shell.size(), 0.0);
  for (const Shares& chunk : shares) {
    for (const auto& [index, area] : chunk) areas[index] += area;
  }
  return areas;
}

}  // namespace sdf_ccd
