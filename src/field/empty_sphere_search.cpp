#include "empty_sphere_search.h"

#include <algorithm>
#include <cmath>

#include "cube_corner.h"

namespace sdf_ccd {

EmptySphereSearch::EmptySphereSearch(Lattice lattice, const Vector3i& size, const std::vector<float>& distances)
    : lattice_(lattice),
      points_(lattice == Lattice::kCenters ? size : Vector3i(size.array() + 1)),
      distances_(distances),
      step_(EmptySphere::step(size)) {}

Vector3i EmptySphereSearch::farthest(const Vector3i& cell) const {
  Vector3i point = cell;
  if (lattice_ == Lattice::kCenters) return point;
  for (int k = 1; k < 8; ++k) {
    const Vector3i corner = cell + cubeCorner(k);
    if (std::abs(distance(corner)) > std::abs(distance(point))) point = corner;
  }
  return point;
}

Vector3d EmptySphereSearch::away(const Vector3i& point) const {
  Vector3d direction;
  for (int k = 0; k < 3; ++k) {
    Vector3i low = point, high = point;
    low[k] = std::max(low[k] - 1, 0);
    high[k] = std::min(high[k] + 1, points_[k] - 1);
    direction[k] = high[k] > low[k] ? double(distance(high) - distance(low)) / (high[k] - low[k]) : 0.0;
  }
  return (distance(point) < 0.0F ? -1.0 : 1.0) * direction.normalized();
}

EmptySphere EmptySphereSearch::ball(const Vector3i& cell) const {
  const Vector3d center = cell.cast<double>().array() + (lattice_ == Lattice::kCenters ? 0.0 : 0.5);
  const auto radius = [&](const Vector3i& point) { return std::abs(double(distance(point))) * (1.0 - 1e-6); };
  // The amount by which a sphere extends beyond the cell's farthest corner.
  const auto cover = [&](const Vector3i& point) {
    return radius(point) - ((point.cast<double>() - center).array().abs() + 0.5).matrix().norm();
  };
  const Vector3i start = farthest(cell);
  Vector3i best = start;
  const Vector3d direction = away(start);
  const double start_cover = std::min(cover(start), 0.0);
  for (const double out : {16.0, 12.0, 9.0, 7.0, 5.0, 4.0, 3.0, 2.0, 1.5, 1.0}) {
    const Vector3i step = (out * direction).array().round().cast<int>(), point = start + step;
    if ((point - cell).cwiseAbs().maxCoeff() > EmptySphere::kMaxOffset) continue;
    if ((point.array() < 0).any() || (point.array() >= points_.array()).any()) continue;
    if ((distance(point) < 0.0F) != (distance(start) < 0.0F)) continue;
    if (radius(start) + step.cast<double>().norm() - radius(point) > EmptySphere::kSlack || cover(point) < start_cover)
      continue;
    best = point;
    break;
  }
  const double steps = std::floor(radius(best) / step_);
  return {best - cell, static_cast<int>(std::min(steps, double(EmptySphere::kMaxSteps))), distance(start) < 0.0F};
}

}  // namespace sdf_ccd
