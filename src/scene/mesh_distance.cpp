#include "scene/mesh_distance.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

/// Of the boundary's triangles, relative to the size of the mesh: the strip along cuts, and gaps that are closed (see
/// Solid).
constexpr double kBoundaryError = 2e-9;

/// @param greatest  upper bound of any depth [m].
double doubtOf(const SolidReport& report, double greatest) {
  return report.failure.empty() ? std::min(report.doubtful_reach, greatest) : greatest;
}

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
    : MeshDistance(oriented, ClosedSolid(std::make_shared<const Solid>(oriented.mesh))) {}

MeshDistance::MeshDistance(const OrientedMesh& oriented, const ClosedSolid& closed)
    : surface_(closed.solid()),
      is_sign_trusted_(oriented.quality.sign_trusted),
      warning_(warningOf(oriented.quality)),
      box_(boundingBox(surface_.solid().boundary())),
      error_(kBoundaryError * box_.sizes().maxCoeff() + closed.moved()),
      doubt_(doubtOf(closed.solid().report(), 0.5 * box_.sizes().minCoeff() + error_)) {
  const Openings& openings = closed.openings();
  if (!openings.reach.empty()) caps_ = std::make_shared<const OpeningCaps>(openings.caps, openings.reach);
}

double MeshDistance::lowerBound(const Vector3d& p_G) const {
  const double distance = box_.exteriorDistance(p_G);
  return distance > 0.0 ? distance : -kInfinity;
}

FieldSample MeshDistance::sample(const Vector3d& p_G) const {
  const TriangleTree::ClosestPoint closest = surface_.tree().closestPoint(p_G);
  const bool is_outside_box = !box_.contains(p_G);
  const double sign = !is_outside_box && surface_.inside(p_G) ? -1.0 : 1.0;
  FieldSample sample;
  sample.value = sign * closest.distance;
  sample.error = sign < 0.0 ? error_ + doubt_ : error_;
  sample.gradient = closest.distance > 0.0
                        ? Vector3d(sign / closest.distance * (p_G - closest.point))
                        : Vector3d(areaNormal(surface_.tree().triangle(closest.triangle).corners()).stableNormalized());
  if (caps_) sample = overMesh(sample, *caps_, p_G);
  const bool is_certain = is_sign_trusted_ || is_outside_box || (sign > 0.0 && surface_.tree().seesOutside(p_G));
  if (!is_certain) sample.error = std::max(sample.error, error_ + 2.0 * closest.distance);
  return sample;
}

}  // namespace sdf_ccd
