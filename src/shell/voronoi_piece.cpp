#include "voronoi_piece.h"

#include <algorithm>

namespace sdf_ccd {

CellPolygon::CellPolygon(const SurfacePiece& piece) {
  std::copy(piece.corners.begin(), piece.corners.end(), corners_.begin());
}

void CellPolygon::keepNearer(const Vector3d& p, const Vector3d& q, bool wins_ties) {
  const Vector3d normal = q - p;
  if (normal.isZero(0)) {
    if (!wins_ties) size_ = 0;
    return;
  }
  // Sutherland & Hodgman 1974, against the bisecting plane.
  const Vector3d middle = (p + q) / 2;
  std::array<double, 3 + kMaxCells> side;
  bool any_outside = false;
  for (int i = 0; i < size_; ++i) {
    side[i] = (corners_[i] - middle).dot(normal);
    any_outside |= side[i] > 0;
  }
  if (!any_outside) return;
  std::array<Vector3d, 3 + kMaxCells> kept;
  int count = 0;
  for (int i = 0; i < size_; ++i) {
    const int next = i + 1 < size_ ? i + 1 : 0;
    // Rounding can make a sliver cross the plane more than twice; corners beyond the capacity have no area.
    if (count + 2 > static_cast<int>(kept.size())) break;
    if (side[i] <= 0) kept[count++] = corners_[i];
    if ((side[i] < 0 && side[next] > 0) || (side[i] > 0 && side[next] < 0)) {
      kept[count++] = corners_[i] + (corners_[next] - corners_[i]) * (side[i] / (side[i] - side[next]));
    }
  }
  std::copy(kept.begin(), kept.begin() + count, corners_.begin());
  size_ = count;
}

double CellPolygon::area() const {
  Vector3d sum = Vector3d::Zero();
  for (int i = 2; i < size_; ++i) sum += (corners_[i - 1] - corners_[0]).cross(corners_[i] - corners_[0]);
  return sum.norm() / 2;
}

double CellPolygon::farthest2(const Vector3d& p) const {
  double result = 0;
  for (int i = 0; i < size_; ++i) result = std::max(result, (corners_[i] - p).squaredNorm());
  return result;
}

}  // namespace sdf_ccd
