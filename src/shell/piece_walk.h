#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nearest_point.h"
#include "sdf_ccd/common/cancel.h"
#include "voronoi_piece.h"

namespace sdf_ccd {

/// Cuts triangles into pieces with few candidates each for the nearest point.
class PieceWalk {
 public:
  /// @param scale   about the distance between points [m].
  /// @param cancel  ends the walk.
  PieceWalk(const NearestPoint& nearest, double scale, const CancelPoint& cancel)
      : nearest_(nearest), cancel_(cancel), scale2_(scale * scale), gather2_(kGather * kGather * scale2_) {}

  /// Calls visit(contested) for pieces that cover `whole`, each with at most kMaxCells candidates, whose normals are
  /// not against `facing`. Before that, settle(contested) may end the matter by returning true.
  template <typename Settle, typename Visit>
  void walk(const SurfacePiece& whole, const Vector3d& facing, Settle settle, Visit visit) {
    stack_.assign(1, {whole, 0, 0});
    while (!stack_.empty()) {
      cancel_.check();
      const Entry current = stack_.back();
      stack_.pop_back();
      // What lies above belongs to pieces that are done; what lies below, to the ones this was halved from.
      candidates_.resize(current.end);
      const double length2 = current.piece.longestEdge().second;
      if (length2 > gather2_) {
        halve(current);
        continue;
      }
      Entry narrowed = current;
      narrowed.begin = current.end;
      if (current.end == current.begin) {
        gather(current.piece, facing);
      } else {
        narrow(current);
      }
      narrowed.end = candidates_.size();
      ContestedPiece contested{current.piece, candidates_.data() + narrowed.begin, candidates_.data() + narrowed.end};
      if (settle(contested)) continue;
      if (contested.size() > kMaxCells && length2 > 1e-12 * scale2_) {
        halve(narrowed);
        continue;
      }
      // So small a piece with more candidates has all of them at one distance: any few will do.
      contested.end = std::min(contested.end, contested.begin + kMaxCells);
      visit(contested);
    }
  }

 private:
  struct Entry {
    SurfacePiece piece;
    std::size_t begin, end;  ///< in candidates_; equal if none have been gathered yet
  };

  /// Looking for points once for a larger piece and sharing them out is cheaper than looking for each small one.
  static constexpr double kGather = 3;

  /// A point that is nearest to some location of the piece is at most this much farther from the piece's centre than
  /// the centre's nearest point: there and back.
  static double margin(const SurfacePiece& piece, const Vector3d& center) {
    return 2 * std::sqrt(piece.farthest2(center)) * (1 + 1e-12);
  }

  void gather(const SurfacePiece& piece, const Vector3d& facing) {
    const Vector3d center = piece.centroid();
    const double reach = std::sqrt(nearest_.find(center, facing).distance2) * (1 + 1e-12) + margin(piece, center);
    nearest_.forEachWithin(center, reach, facing, [&](std::int32_t index, const Vector3d& point) {
      candidates_.push_back({point, index});
    });
  }

  void narrow(const Entry& entry) {
    const Vector3d center = entry.piece.centroid();
    double nearest2 = std::numeric_limits<double>::infinity();
    for (std::size_t i = entry.begin; i < entry.end; ++i) {
      nearest2 = std::min(nearest2, (candidates_[i].point - center).squaredNorm());
    }
    const double reach = std::sqrt(nearest2) * (1 + 1e-12) + margin(entry.piece, center);
    for (std::size_t i = entry.begin; i < entry.end; ++i) {
      if ((candidates_[i].point - center).squaredNorm() > reach * reach) continue;
      const Candidate kept = candidates_[i];
      candidates_.push_back(kept);
    }
  }

  void halve(const Entry& entry) {
    const auto [first, second] = entry.piece.halves();
    stack_.push_back({first, entry.begin, entry.end});
    stack_.push_back({second, entry.begin, entry.end});
  }

  const NearestPoint& nearest_;
  const CancelPoint cancel_;
  double scale2_;
  double gather2_;  ///< pieces with a longer edge, squared, are halved before points are looked for
  std::vector<Entry> stack_;
  std::vector<Candidate> candidates_;
};

}  // namespace sdf_ccd
