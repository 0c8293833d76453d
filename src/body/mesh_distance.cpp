#include "body/mesh_distance.h"

#include <cmath>
#include <memory>
#include <utility>
#include <variant>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

/// Of the boundary's triangles, relative to the size of the mesh: the strip along cuts, and gaps that are closed (see
/// Solid).
constexpr double kBoundaryError = 2e-9;

OrientedMesh orientedMesh(const GeometryDescription& geometry) {
  const TriangleMesh& mesh = *std::get<std::shared_ptr<const TriangleMesh>>(geometry.shape);
  if (!geometry.watertight_voxels) return orientOutward(mesh);
  OrientedMesh voxels{mesh, {}};
  voxels.quality.sign_trusted = true;
  return voxels;
}

}  // namespace

MeshDistance::MeshDistance(const GeometryDescription& geometry) : MeshDistance(orientedMesh(geometry)) {
  if (!warning_.empty()) warning_ = geometry.source + ": " + warning_;
}

MeshDistance::MeshDistance(const OrientedMesh& oriented)
    : surface_(oriented.mesh),
      is_sign_trusted_(oriented.quality.sign_trusted),
      warning_(warningOf(oriented.quality)),
      box_(boundingBox(oriented.mesh)),
      error_(kBoundaryError * box_.sizes().maxCoeff()) {}

double MeshDistance::lowerBound(const Vector3d& p_G) const {
  const double distance = box_.exteriorDistance(p_G);
  return distance > 0.0 ? distance : -kInfinity;
}

FieldSample MeshDistance::sample(const Vector3d& p_G) const {
  const TriangleTree::ClosestPoint closest = surface_.tree().closestPoint(p_G);
  const bool is_certainly_outside = !box_.contains(p_G) || (!is_sign_trusted_ && surface_.tree().seesOutside(p_G));
  const double sign = !is_certainly_outside && surface_.inside(p_G) ? -1.0 : 1.0;
  FieldSample sample;
  sample.value = sign * closest.distance;
  sample.error = error_ + (is_sign_trusted_ || is_certainly_outside ? 0.0 : 2.0 * closest.distance);
  sample.gradient = closest.distance > 0.0
                        ? Vector3d(sign / closest.distance * (p_G - closest.point))
                        : Vector3d(areaNormal(surface_.tree().triangle(closest.triangle).corners()).stableNormalized());
  return sample;
}

}  // namespace sdf_ccd
