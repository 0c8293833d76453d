#include "ros/world_markers.h"

#include "ros/conversions.h"

namespace sdf_ccd {
namespace {

using visualization_msgs::Marker;

constexpr double kPlaneSize = 4.0;  // [m]
constexpr double kPlaneThickness = 0.002;

void setScale(const Vector3d& scale, Marker& marker) {
  marker.scale = toVector3(scale);
}

void setShape(const Primitive& primitive, Marker& marker) {
  if (const Sphere* sphere = std::get_if<Sphere>(&primitive)) {
    marker.type = Marker::SPHERE;
    setScale(Vector3d::Constant(2.0 * sphere->radius), marker);
  } else if (const Box* box = std::get_if<Box>(&primitive)) {
    marker.type = Marker::CUBE;
    setScale(2.0 * box->half_size, marker);
  } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&primitive)) {
    marker.type = Marker::CYLINDER;
    setScale({2.0 * cylinder->radius, 2.0 * cylinder->radius, 2.0 * cylinder->half_length}, marker);
  } else {  // a half-space of the parameters: solid where z < 0
    marker.type = Marker::CUBE;
    setScale({kPlaneSize, kPlaneSize, kPlaneThickness}, marker);
  }
}

void setShape(const TriangleMesh& mesh, Marker& marker) {
  marker.type = Marker::TRIANGLE_LIST;
  setScale(Vector3d::Ones(), marker);
  for (const Vector3i& triangle : mesh.triangles) {
    for (const int vertex : triangle) marker.points.push_back(toPoint(mesh.vertices[vertex]));
  }
}

}  // namespace

visualization_msgs::MarkerArray toWorldMarkers(const SceneDescription& scene) {
  visualization_msgs::MarkerArray markers;
  for (const BodyDescription& body : scene.bodies) {
    if (!body.is_world) continue;
    for (const GeometryDescription& geometry : body.geometry) {
      if (geometry.watertight_voxels) continue;
      Marker marker;
      marker.header.frame_id = body.frame;
      marker.ns = body.name;
      marker.id = static_cast<int>(markers.markers.size());
      marker.action = Marker::ADD;
      marker.frame_locked = true;
      marker.pose = toPose(body.X_frame_B * geometry.X_BG);
      marker.color.r = 0.7f;
      marker.color.g = 0.85f;
      marker.color.b = 0.8f;
      marker.color.a = 0.6f;
      if (const Primitive* primitive = std::get_if<Primitive>(&geometry.shape)) {
        setShape(*primitive, marker);
      } else {
        setShape(*std::get<std::shared_ptr<const TriangleMesh>>(geometry.shape), marker);
      }
      markers.markers.push_back(std::move(marker));
    }
  }
  return markers;
}

}  // namespace sdf_ccd
