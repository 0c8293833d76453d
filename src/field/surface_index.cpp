#include "surface_index.h"

namespace sdf_ccd {

SurfaceIndex::SurfaceIndex(Solid solid) : exact_(std::move(solid)) {
  const TriangleMesh& mesh = exact_.solid().boundary();
  const std::vector<std::uint8_t>& separates = exact_.solid().separates();
  triangles_.reserve(mesh.triangles.size());
  faces_.reserve(mesh.triangles.size());
  flat_.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    triangles_.emplace_back(a, b, c);
    faces_.push_back(
        {areaNormal(mesh, static_cast<int>(i)).normalized(), separates[i] != 0, triangles_.back().sliver()});
    flat_.emplace_back(a, b, c);
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

void SurfaceIndex::ways(int i, const PointLanes& points, DisplacementLanes& ways) const {
  if (!face(i).sliver) return sdf_ccd::ways(flat_[static_cast<std::size_t>(i)], points, ways);
  for (int k = 0; k < PointLanes::kCount; ++k) {
    const Vector3d p = points.at(k), displacement = p - triangle(i).closest(p);
    ways.distance2[k] = displacement.squaredNorm();
    ways.x[k] = displacement.x();
    ways.y[k] = displacement.y();
    ways.z[k] = displacement.z();
  }
}

}  // namespace sdf_ccd
