#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/cancel_point.h"
#include "common/infinity.h"
#include "nearest_point.h"
#include "surface_piece.h"
#include "voronoi_piece.h"

namespace sdf_ccd {

/// Cuts triangles into pieces, each with few candidates for the nearest point.
class PieceWalk {
 public:
  /// @param scale   approximate distance between points [m].
  /// @param cancel  stops the walk.
  PieceWalk(const NearestPoint& nearest, double scale, const CancelPoint& cancel)
      : nearest_(nearest),
        cancel_(cancel),
        scale_(scale),
        scale2_(scale * scale),
        coincident2_(kCoincident * kCoincident * scale2_),
        gather2_(kGather * kGather * scale2_) {}

  /// Calls visit(contested) for pieces that cover `whole`, each with at most kMaxCells candidates, whose normals do not
  /// oppose `facing`. Before that, is_finished(contested) may finish a piece by returning true.
  template <typename IsFinished, typename Visit>
  void walk(const SurfacePiece& whole, const Vector3d& facing, IsFinished is_finished, Visit visit) {
    forEachCompactPiece(whole, scale_,
                        [&](const SurfacePiece& piece) { walkPiece(piece, facing, is_finished, visit); });
  }

 private:
  struct Entry {
    SurfacePiece piece;
    std::size_t begin, end;  ///< in candidates_; equal if none have been gathered yet
  };

  /// Searching once for a larger piece and distributing the points is cheaper than searching for each small one.
  static constexpr double kGather = 5;

  /// Points that are nearer to each other than this share of the scale count as one. They divide no piece, however
  /// small, if they differ by rounding only.
  static constexpr double kCoincident = 1e-9;

  template <typename IsFinished, typename Visit>
  void walkPiece(const SurfacePiece& whole, const Vector3d& facing, IsFinished& is_finished, Visit& visit) {
    stack_.assign(1, {whole, 0, 0});
    while (!stack_.empty()) {
      cancel_.check();
      const Entry current = stack_.back();
      stack_.pop_back();
      // Candidates beyond this piece's belong to finished pieces; those before, to the pieces that contain this one.
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
      if (candidates_.size() - narrowed.begin > kMaxCells) mergeCoincident(narrowed.begin);
      narrowed.end = candidates_.size();
      ContestedPiece contested{current.piece, candidates_.data() + narrowed.begin, candidates_.data() + narrowed.end};
      if (is_finished(contested)) continue;
      if (contested.size() > kMaxCells && length2 > 1e-12 * scale2_) {
        halve(narrowed);
        continue;
      }
      // All candidates of so small a piece are at the same distance, so any kMaxCells of them suffice.
      contested.end = std::min(contested.end, contested.begin + kMaxCells);
      visit(contested);
    }
  }

  /// Gathers all points that may be nearest to a location of the piece. Let q be the point nearest to the centre: a
  /// location's nearest point is at most as far from it as q, which is at most as far as q is from its farthest corner.
  void gather(const SurfacePiece& piece, const Vector3d& facing) {
    const Vector3d center = centroid(piece.corners);
    const NearestPoint::Hit hit = nearest_.find(center, facing);
    if (hit.index < 0) return;
    const double reach = std::sqrt(piece.farthest2(hit.point)) + std::sqrt(piece.farthest2(center));
    gathered_.clear();
    nearest_.forEachWithin(center, (1 + 1e-12) * reach, facing, [&](std::int32_t index, const Vector3d& point) {
      gathered_.push_back({point, index});
    });
    keepContestants(piece);
  }

  void narrow(const Entry& entry) {
    gathered_.assign(candidates_.begin() + entry.begin, candidates_.begin() + entry.end);
    keepContestants(entry.piece);
  }

  /// Adds the gathered points to the candidates, except those that another point beats: one that is nearer to all
  /// corners. It is nearer to the whole piece then, because a plane divides the locations nearer to the one from those
  /// nearer to the other. Only the points nearest to the corners and to the centre are tried as such rivals.
  void keepContestants(const SurfacePiece& piece) {
    constexpr double kSurely = 1 - 1e-12;
    const std::size_t count = gathered_.size();
    to_corners2_.resize(count);
    std::array<std::size_t, 4> rivals{};
    std::array<double, 4> least;
    least.fill(kInfinity);
    for (std::size_t i = 0; i < count; ++i) {
      Vector3d& to2 = to_corners2_[i];
      for (int k = 0; k < 3; ++k) to2[k] = (piece.corners[k] - gathered_[i].point).squaredNorm();
      const std::array<double, 4> values{to2[0], to2[1], to2[2],
                                         to2.sum()};  // the sum orders points as the distance from the centre does
      for (std::size_t k = 0; k < 4; ++k) {
        if (values[k] < least[k]) {
          least[k] = values[k];
          rivals[k] = i;
        }
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_beaten = std::any_of(rivals.begin(), rivals.end(), [&](std::size_t rival) {
        return (to_corners2_[rival].array() < kSurely * to_corners2_[i].array()).all();
      });
      if (!is_beaten) candidates_.push_back(gathered_[i]);
    }
  }

  /// Keeps one of the candidates from `begin` on that coincide, the first of the shell.
  void mergeCoincident(std::size_t begin) {
    const auto first = candidates_.begin() + static_cast<std::ptrdiff_t>(begin);
    auto kept = first;
    for (auto candidate = first; candidate != candidates_.end(); ++candidate) {
      const auto known = std::find_if(first, kept, [&](const Candidate& other) {
        return (other.point - candidate->point).squaredNorm() < coincident2_;
      });
      if (known == kept) {
        *kept++ = *candidate;
      } else if (candidate->index < known->index) {
        *known = *candidate;
      }
    }
    candidates_.erase(kept, candidates_.end());
  }

  void halve(const Entry& entry) {
    const auto [first, second] = entry.piece.halves();
    stack_.push_back({first, entry.begin, entry.end});
    stack_.push_back({second, entry.begin, entry.end});
  }

  const NearestPoint& nearest_;
  const CancelPoint cancel_;
  double scale_, scale2_;
  double coincident2_;  ///< [m²]
  double gather2_;      ///< squared edge length above which pieces are halved before points are searched [m²]
  std::vector<Entry> stack_;
  std::vector<Candidate> candidates_;
  std::vector<Candidate> gathered_;
  std::vector<Vector3d> to_corners2_;  // of gathered_: squared distances from the piece's corners
};

}  // namespace sdf_ccd
