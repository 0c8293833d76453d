#include "ros/messages/shape_marker.h"

#include "ros/messages/conversions.h"

namespace sdf_ccd {
namespace {

using visualization_msgs::Marker;

constexpr double kPlaneSize = 4.0;  // [m]
constexpr double kPlaneThickness = 0.002;

void setPrimitive(const Primitive& primitive, Marker& marker) {
  if (const Sphere* sphere = std::get_if<Sphere>(&primitive)) {
    marker.type = Marker::SPHERE;
    marker.scale = toVector3(Vector3d::Constant(2.0 * sphere->radius));
  } else if (const Box* box = std::get_if<Box>(&primitive)) {
    marker.type = Marker::CUBE;
    marker.scale = toVector3(box->size);
  } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&primitive)) {
    marker.type = Marker::CYLINDER;
    marker.scale = toVector3({2.0 * cylinder->radius, 2.0 * cylinder->radius, cylinder->length});
  } else {  // a half-space: the plane z = 0 of markerPose()
    marker.type = Marker::CUBE;
    marker.scale = toVector3({kPlaneSize, kPlaneSize, kPlaneThickness});
  }
}

bool rvizFinds(const std::string& uri) {
  for (const char* scheme : {"package://", "file://"}) {
    if (uri.rfind(scheme, 0) == 0) return uri.rfind(std::string(scheme) + "/", 0) != 0 || scheme[0] == 'f';
  }
  return false;
}

}  // namespace

std_msgs::ColorRGBA toColor(float r, float g, float b, float a) {
  std_msgs::ColorRGBA color;
  color.r = r;
  color.g = g;
  color.b = b;
  color.a = a;
  return color;
}

std_msgs::ColorRGBA verdictColor(Verdict verdict, float alpha) {
  switch (verdict) {
    case Verdict::kClear:
      return toColor(0.34F, 0.71F, 0.91F, alpha);
    case Verdict::kUncertain:
      return toColor(0.94F, 0.89F, 0.26F, alpha);
    case Verdict::kContact:
      return toColor(0.90F, 0.35F, 0.0F, alpha);
    case Verdict::kNotChecked:
      break;
  }
  return toColor(0.80F, 0.47F, 0.65F, alpha);
}

Marker makeMarker(const std::string& frame, const std::string& name, int id, int type) {
  Marker marker;
  marker.header.frame_id = frame;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

Marker deleteAllMarker(const std::string& frame) {
  Marker marker = makeMarker(frame, "", 0, Marker::SPHERE);
  marker.action = Marker::DELETEALL;
  return marker;
}

void setTriangles(const TriangleMesh& mesh, Marker& marker) {
  marker.type = Marker::TRIANGLE_LIST;
  marker.scale = toVector3(Vector3d::Ones());
  marker.points.reserve(3 * mesh.triangles.size());
  for (const Vector3i& triangle : mesh.triangles) {
    for (const int vertex : triangle) marker.points.push_back(toPoint(mesh.vertices[vertex]));
  }
}

Isometry3d markerPose(const GeometryDescription& geometry) {
  const auto* primitive = std::get_if<Primitive>(&geometry.shape);
  const auto* half_space = primitive ? std::get_if<HalfSpace>(primitive) : nullptr;
  if (!half_space) return geometry.X_BG;
  const Vector3d& n = half_space->normal;
  return geometry.X_BG * Eigen::Translation3d(half_space->offset * n) *
         Quaterniond::FromTwoVectors(Vector3d::UnitZ(), n);
}

void setShape(const GeometryDescription& geometry, Marker& marker) {
  if (const Primitive* primitive = std::get_if<Primitive>(&geometry.shape)) {
    setPrimitive(*primitive, marker);
  } else if (geometry.scale && rvizFinds(geometry.source)) {
    marker.type = Marker::MESH_RESOURCE;
    marker.mesh_resource = geometry.source;
    marker.scale = toVector3(*geometry.scale);
  } else {
    setTriangles(*std::get<std::shared_ptr<const TriangleMesh>>(geometry.shape), marker);
  }
}

}  // namespace sdf_ccd
