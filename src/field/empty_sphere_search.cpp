#include "empty_sphere_search.h"

#include <algorithm>
#include <cmath>

#include "cube_corner.h"

namespace sdf_ccd {

EmptySphereSearch::EmptySphereSearch(Lattice lattice, const Vector3i& size, const std::vector<float>& distances)
    : lattice_(lattice),
      places_(lattice == Lattice::kCenters ? size : Vector3i(size.array() + 1)),
      distances_(distances),
      step_(EmptySphere::step(size)) {}

Vector3i EmptySphereSearch::farthest(const Vector3i& cell) const {
  Vector3i place = cell;
  if (lattice_ == Lattice::kCenters) return place;
  for (int k = 1; k < 8; ++k) {
    const Vector3i corner = cell + cubeCorner(k);
    if (std::abs(distance(corner)) > std::abs(distance(place))) place = corner;
  }
  return place;
}

Vector3d EmptySphereSearch::away(const Vector3i& place) const {
  Vector3d way;
  for (int k = 0; k < 3; ++k) {
    Vector3i low = place, high = place;
    low[k] = std::max(low[k] - 1, 0);
    high[k] = std::min(high[k] + 1, places_[k] - 1);
    way[k] = high[k] > low[k] ? double(distance(high) - distance(low)) / (high[k] - low[k]) : 0.0;
  }
  return (distance(place) < 0.0F ? -1.0 : 1.0) * way.normalized();
}

EmptySphere EmptySphereSearch::ball(const Vector3i& cell) const {
  const Vector3d center = cell.cast<double>().array() + (lattice_ == Lattice::kCenters ? 0.0 : 0.5);
  const auto radius = [&](const Vector3i& place) { return std::abs(double(distance(place))) * (1.0 - 1e-6); };
  // By how much a ball reaches beyond the cell's farthest corner.
  const auto cover = [&](const Vector3i& place) {
    return radius(place) - ((place.cast<double>() - center).array().abs() + 0.5).matrix().norm();
  };
  const Vector3i own = farthest(cell);
  Vector3i best = own;
  const Vector3d way = away(own);
  const double own_cover = std::min(cover(own), 0.0);
  for (const double out : {16.0, 12.0, 9.0, 7.0, 5.0, 4.0, 3.0, 2.0, 1.5, 1.0}) {
    const Vector3i step = (out * way).array().round().cast<int>(), place = own + step;
    if ((place - cell).cwiseAbs().maxCoeff() > EmptySphere::kMostOffset) continue;
    if ((place.array() < 0).any() || (place.array() >= places_.array()).any()) continue;
    if ((distance(place) < 0.0F) != (distance(own) < 0.0F)) continue;
    if (radius(own) + step.cast<double>().norm() - radius(place) > EmptySphere::kSlack || cover(place) < own_cover)
      continue;
    best = place;
    break;
  }
  const double steps = std::floor(radius(best) / step_);
  return {best - cell, static_cast<int>(std::min(steps, double(EmptySphere::kMostSteps))), distance(own) < 0.0F};
}

}  // namespace sdf_ccd
