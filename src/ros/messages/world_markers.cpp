#include "ros/messages/world_markers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ros/messages/conversions.h"
#include "ros/messages/shape_marker.h"

namespace sdf_ccd {
namespace {

using visualization_msgs::Marker;

AlignedBox3d boxOf(const TriangleMesh& mesh, const Vector3i& triangle) {
  AlignedBox3d box;
  for (const int vertex : triangle) box.extend(mesh.vertices[vertex]);
  return box;
}

/// From dark at 0 to light at 1: colours are left to the verdicts.
std_msgs::ColorRGBA heightColor(double share) {
  const auto grey = static_cast<float>(0.25 + 0.5 * share);
  return toColor(grey, grey, grey, 1.0F);
}

void setVoxels(const TriangleMesh& surface, Marker& marker) {
  double size = 0.0;
  const std::vector<Vector3d> centers = surfaceVoxels(surface, size);
  marker.type = Marker::CUBE_LIST;
  marker.scale = toVector3(Vector3d::Constant(size));
  const AlignedBox3d box = boundingBox(surface);
  for (const Vector3d& center : centers) {
    marker.points.push_back(toPoint(center));
    marker.colors.push_back(heightColor((center.z() - box.min().z()) / box.sizes().z()));
  }
}

}  // namespace

std::vector<Vector3d> surfaceVoxels(const TriangleMesh& surface, double& size) {
  using Index = std::array<long, 3>;
  std::vector<Index> voxels;
  voxels.reserve(surface.triangles.size());
  size = boxOf(surface, surface.triangles.front()).sizes().maxCoeff();
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    // Two triangles make a face, and each one's bounding box is the face. It lies half a voxel outside the voxel's
    // centre.
    const Vector3d face = boxOf(surface, surface.triangles[i]).center();
    const Vector3d center = face - 0.5 * size * areaNormal(surface, static_cast<int>(i)).normalized();
    voxels.push_back({std::lround(center.x() / size - 0.5), std::lround(center.y() / size - 0.5),
                      std::lround(center.z() / size - 0.5)});
  }
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  std::vector<Vector3d> centers;
  for (const Index& voxel : voxels) {
    centers.push_back(size * Vector3d(double(voxel[0]) + 0.5, double(voxel[1]) + 0.5, double(voxel[2]) + 0.5));
  }
  return centers;
}

visualization_msgs::MarkerArray toWorldMarkers(const SceneDescription& scene) {
  visualization_msgs::MarkerArray markers;
  for (const BodyDescription& body : scene.bodies) {
    if (!body.is_world || !body.failure.empty()) continue;
    for (const GeometryDescription& geometry : body.geometry) {
      const int id = static_cast<int>(markers.markers.size());
      Marker marker = makeMarker(body.frame, body.name, id, Marker::CUBE);
      marker.frame_locked = true;
      marker.pose = toPose(body.X_frame_B * markerPose(geometry));
      marker.color = toColor(0.75F, 0.78F, 0.76F, 0.35F);
      if (geometry.watertight_voxels) {
        setVoxels(*std::get<std::shared_ptr<const TriangleMesh>>(geometry.shape), marker);
      } else {
        setShape(geometry, marker);
      }
      markers.markers.push_back(std::move(marker));
    }
  }
  return markers;
}

}  // namespace sdf_ccd
