/// First hits of random segments on the interpolated field against exact hits on the mesh (Embree, robust), over the
/// cell size. Prints rows of results.csv.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <embree3/rtcore.h>
#include <CLI/CLI.hpp>

#include "oracle/random.h"
#include "oracle/shapes.h"
#include "results.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/geometry/mesh_file.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "sdf_ccd/query/segment_query.h"

namespace sdf_ccd::benchmark {
namespace {

/// Exact first hits on a mesh.
class MeshRays {
 public:
  explicit MeshRays(const TriangleMesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
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
  ~MeshRays() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  MeshRays(const MeshRays&) = delete;
  MeshRays& operator=(const MeshRays&) = delete;

  /// Parameter in [0, 1] of the first hit; negative if there is none.
  double firstHit(const Segment& s) const {
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
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1.0 : double(ray.ray.tfar);
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

double quantile(std::vector<double>& values, double q) {
  const auto at = values.begin() + std::ptrdiff_t(q * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void study(const std::string& name, const TriangleMesh& given, int segments, int finest) {
  const TriangleMesh mesh = orientOutward(given).mesh;
  const MeshRays rays(mesh);
  AlignedBox3d box = boundingBox(mesh);
  const double side = box.sizes().maxCoeff();
  box = {box.min().array() - 0.2 * side, box.max().array() + 0.2 * side};
  double last_median = 0.0;
  for (int cells = 32; cells <= finest; cells *= 2) {
    FieldOptions options;
    options.cells = cells;
    const DistanceField field = buildField(mesh, options);
    test::Random random(1);
    std::vector<double> errors, distances;
    int only_mesh = 0, only_field = 0;
    for (int i = 0; i < segments; ++i) {
      Segment s{test::uniformIn(random, box), test::uniformIn(random, box)};
      // Both rays and fields answer for segments that start outside; inside, the field's interval starts at once.
      if (field.sample(s.start).value <= field.errorBound()) continue;
      const double exact = rays.firstHit(s);
      const Intervals found = segmentIntervals(field, s, {0.0, true});
      only_mesh += exact >= 0.0 && found.empty();
      only_field += exact < 0.0 && !found.empty();
      if (exact < 0.0 || found.empty()) continue;
      errors.push_back(std::abs(found[0].enter - exact) * (s.end - s.start).norm());
      // The same without the angle of incidence: how far the exact hit is from the field's isosurface.
      distances.push_back(std::abs(field.sample(s.start + exact * (s.end - s.start)).value));
    }
    if (errors.empty()) throw std::runtime_error(name + ": no segment hits both the mesh and its field");
    const std::string row = name + "/" + std::to_string(cells);
    const auto add = [&](const std::string& metric, double value, const std::string& unit) {
      print({"accuracy", row, "sdf_ccd", metric, value, unit, int(errors.size())});
    };
    const double median = quantile(distances, 0.5) / side;
    add("hit_distance_median", quantile(errors, 0.5) / side, "box side");
    add("hit_distance_p99", quantile(errors, 0.99) / side, "box side");
    add("surface_error_median", median, "box side");
    add("surface_error_p99", quantile(distances, 0.99) / side, "box side");
    add("surface_error_max", quantile(distances, 1.0) / side, "box side");
    add("bound", field.errorBound() / side, "box side");
    add("hits_of_mesh_only", only_mesh, "segments");
    add("hits_of_field_only", only_field, "segments");
    if (last_median > 0.0) add("order", std::log2(last_median / median), "1");
    last_median = median;
  }
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd;
  CLI::App app{"Error of segment queries against exact mesh hits, over the cell size"};
  std::vector<std::string> meshes;
  int segments = 20000, finest = 512;
  app.add_option("--mesh", meshes, "NAME=FILE, as often as wanted; without any, shapes of our own");
  app.add_option("--segments", segments, "random segments per field");
  app.add_option("--finest", finest, "cells along the longest side, from 32 in doublings");
  CLI11_PARSE(app, argc, argv);
  try {
    if (meshes.empty()) {
      benchmark::study("torus", test::torusMesh(0.2, 0.08, 128, 64), segments, finest);
      benchmark::study("box", test::boxMesh({0.2, 0.15, 0.1}), segments, finest);
    }
    for (const std::string& mesh : meshes) {
      const std::size_t equals = mesh.find('=');
      if (equals == std::string::npos) throw std::invalid_argument("--mesh " + mesh + ": NAME=FILE is wanted");
      benchmark::study(mesh.substr(0, equals), loadMesh(mesh.substr(equals + 1)), segments, finest);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "accuracy_benchmark: %s\n", error.what());
    return 2;
  }
}
