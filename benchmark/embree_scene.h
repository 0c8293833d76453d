#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>

#include <embree3/rtcore.h>

#include "sdf_ccd/mesh.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::benchmark {

/// A mesh in Embree, with the robust flag, so that no ray passes between two adjacent triangles.
class EmbreeScene {
 public:
  explicit EmbreeScene(const TriangleMesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetDeviceMemoryMonitorFunction(device_, &EmbreeScene::onMemory, &bytes_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.vertices.size()));
    for (const Vector3d& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(v[k]);
    auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
    for (const Vector3i& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) *triangles++ = static_cast<unsigned>(t[k]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCScene get() const { return scene_; }

  /// Memory of vertices, triangles and hierarchy.
  std::size_t bytes() const { return std::size_t(bytes_.load()); }

  /// The segment as a ray, t from 0 to 1.
  static RTCRayHit ray(const Segment& s) {
    RTCRayHit ray{};
    const Vector3d d = s.end - s.start;
    ray.ray.org_x = float(s.start.x());
    ray.ray.org_y = float(s.start.y());
    ray.ray.org_z = float(s.start.z());
    ray.ray.dir_x = float(d.x());
    ray.ray.dir_y = float(d.y());
    ray.ray.dir_z = float(d.z());
    ray.ray.tfar = 1.0F;
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return ray;
  }

  /// Parameter in [0, 1] of the first hit; negative if there is none.
  double firstHit(const Segment& s) const {
    RTCRayHit ray = EmbreeScene::ray(s);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1.0 : double(ray.ray.tfar);
  }

  /// Winding number of the closed mesh at the segment's start: crossings out of the mesh minus crossings into it. The
  /// segment's end must be outside.
  int windingNumber(const Segment& s) const {
    RTCRayHit ray = EmbreeScene::ray(s);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    int number = 0;
    for (;;) {
      rtcIntersect1(scene_, &context, &ray);
      if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return number;
      const float out = ray.hit.Ng_x * ray.ray.dir_x + ray.hit.Ng_y * ray.ray.dir_y + ray.hit.Ng_z * ray.ray.dir_z;
      number += (out > 0.0F) - (out < 0.0F);
      ray.ray.tnear = std::nextafter(ray.ray.tfar, 2.0F);
      ray.ray.tfar = 1.0F;
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
  }

 private:
  static bool onMemory(void* bytes, ssize_t change, bool) {
    *static_cast<std::atomic<ssize_t>*>(bytes) += change;
    return true;
  }

  std::atomic<ssize_t> bytes_{0};
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace sdf_ccd::benchmark
