#include "measure_shell.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/parallel_for.h"
#include "piece_walk.h"

namespace sdf_ccd {
namespace {

/// What a task has found.
struct Found {
  std::vector<std::pair<std::int32_t, double>> shares;  // of points, in the area [m²]
  double farthest2 = 0.0;                               // of a part from its point, squared [m²]
};

/// Adds the cells of one triangle to its points' shares.
void divide(const SurfacePiece& whole, const Vector3d& facing, PieceWalk& pieces, Found& found) {
  const auto belongsToOne = [&](const ContestedPiece& contested) {
    if (contested.size() > 1) return false;
    const Candidate& owner = *contested.begin;
    found.shares.emplace_back(owner.index, contested.piece.area());
    found.farthest2 = std::max(found.farthest2, contested.piece.farthest2(owner.point));
    return true;
  };
  pieces.walk(whole, facing, belongsToOne, [&](const ContestedPiece& contested) {
    const std::size_t first = found.shares.size();
    double sum = 0;
    forEachCell(contested, [&](const Candidate& candidate, const CellPolygon& cell) {
      found.shares.emplace_back(candidate.index, cell.area());
      found.farthest2 = std::max(found.farthest2, cell.farthest2(candidate.point));
      sum += found.shares.back().second;
    });
    // Up to rounding, the cells fill the piece. Normalised, so that rounding does not accumulate.
    const double area = contested.piece.area();
    for (std::size_t share = first; share < found.shares.size(); ++share) {
      found.shares[share].second *= sum > 0 ? area / sum : 0;
    }
    if (!(sum > 0)) found.shares.emplace_back(contested.begin->index, area);
  });
}

}  // namespace

ShellMeasures measureShell(const TriangleMesh& mesh, const PointShell& shell, double scale) {
  constexpr std::size_t kChunk = 64;  // triangles of a task; fixed, so that results do not depend on threads
  const NearestPoint nearest(shell);
  const CancelPoint cancel;
  const std::size_t count = mesh.triangles.size();
  std::vector<Found> found((count + kChunk - 1) / kChunk);
  parallelFor(std::size_t{0}, found.size(), [&](std::size_t chunk) {
    PieceWalk pieces(nearest, scale, cancel);
    for (std::size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i) {
      const SurfacePiece whole = SurfacePiece::of(mesh, static_cast<int>(i));
      Vector3d facing = areaNormal(mesh, static_cast<int>(i));
      if (nearest.find(whole.corners[0], facing).index < 0) facing.setZero();
      divide(whole, facing, pieces, found[chunk]);
    }
  });
  ShellMeasures measures;
  measures.areas.assign(shell.size(), 0.0);
  double farthest2 = 0.0;
  for (const Found& chunk : found) {
    for (const auto& [index, area] : chunk.shares) measures.areas[index] += area;
    farthest2 = std::max(farthest2, chunk.farthest2);
  }
  const AlignedBox3d box = boundingBox(mesh);
  const double rounding = 1e-14 * (box.min().cwiseAbs().maxCoeff() + box.sizes().norm()) + 1e-9 * scale;
  measures.covering_radius = std::sqrt(farthest2) * (1 + 1e-9) + rounding;
  return measures;
}

}  // namespace sdf_ccd
