#include "surface_index.h"

namespace sdf_ccd {

SurfaceIndex::SurfaceIndex(Solid solid) : exact_(std::move(solid)) {
  const TriangleMesh& mesh = exact_.solid().boundary();
  const std::vector<std::uint8_t>& separates = exact_.solid().separates();
  triangles_.reserve(mesh.triangles.size());
  faces_.reserve(mesh.triangles.size());
  flat_.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Corners corners = cornersOf(mesh, static_cast<int>(i));
    triangles_.emplace_back(corners);
    faces_.push_back({areaNormal(corners).normalized(), separates[i] != 0, triangles_.back().sliver()});
    flat_.emplace_back(corners);
  }
}

void SurfaceIndex::offer(int i, const Vector3d& axis, const PointLanes& points, ClosestLanes& closest) const {
  if (!face(i).sliver) return sdf_ccd::offer(flat_[static_cast<std::size_t>(i)], axis, points, closest);
  for (int k = 0; k < PointLanes::kCount; ++k) {
    const Vector3d p = points.at(k), displacement = p - triangle(i).closest(p);
    if (displacement.squaredNorm() >= closest.distance2[k]) continue;
    closest.distance2[k] = displacement.squaredNorm();
    closest.side[k] = displacement.dot(axis);
  }
}

void SurfaceIndex::displacements(int i, const PointLanes& points, DisplacementLanes& found) const {
  if (!face(i).sliver) return sdf_ccd::displacements(flat_[static_cast<std::size_t>(i)], points, found);
  for (int k = 0; k < PointLanes::kCount; ++k) {
    const Vector3d p = points.at(k), displacement = p - triangle(i).closest(p);
    found.distance2[k] = displacement.squaredNorm();
    found.x[k] = displacement.x();
    found.y[k] = displacement.y();
    found.z[k] = displacement.z();
  }
}

}  // namespace sdf_ccd
