#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sdf_ccd/types.h"
#include "surface_piece.h"

namespace sdf_ccd {

/// A point of a shell that may be the nearest one to a location of a surface piece.
struct Candidate {
  Vector3d point;
  std::int32_t index;
};

/// A piece with all its candidates.
struct ContestedPiece {
  SurfacePiece piece;
  const Candidate* begin;
  const Candidate* end;

  std::size_t size() const { return static_cast<std::size_t>(end - begin); }
};

/// Above this number of candidates a piece is halved rather than cut.
constexpr std::size_t kMaxCells = 10;

/// The part of a piece that is nearest to one of its candidates: a convex polygon.
class CellPolygon {
 public:
  explicit CellPolygon(const SurfacePiece& piece);

  /// Keeps the part nearer to p than to q. If p = q, keeps all of it if `wins_ties`, else nothing.
  void keepNearer(const Vector3d& p, const Vector3d& q, bool wins_ties);

  bool empty() const { return size_ == 0; }
  double area() const;
  /// Largest distance of the polygon from p, squared.
  double farthest2(const Vector3d& p) const;

 private:
  std::array<Vector3d, 3 + kMaxCells> corners_;  // a cut by a plane adds at most one corner
  int size_ = 3;
};

/// Calls visit(candidate, polygon) for every candidate's part of the piece.
template <typename Visit>
void forEachCell(const ContestedPiece& contested, Visit visit) {
  for (const Candidate* own = contested.begin; own != contested.end; ++own) {
    CellPolygon polygon(contested.piece);
    for (const Candidate* other = contested.begin; other != contested.end && !polygon.empty(); ++other) {
      if (other != own) polygon.keepNearer(own->point, other->point, own->index < other->index);
    }
    if (!polygon.empty()) visit(*own, polygon);
  }
}

}  // namespace sdf_ccd
