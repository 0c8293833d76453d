#include "scene/doubtful_surface.h"

#include "mesh/mesh_edges.h"

namespace sdf_ccd {
namespace {

/// Caps of a mesh that is not closed, from findOpenings(), also if its faces only seem to meet; empty for a closed
/// mesh.
const TriangleMesh& capsOf(PooledMesh& pooled) {
  static const TriangleMesh kNone;
  return isClosed(pooled.mesh) ? kNone : SolidSource(pooled.mesh, pooled.made).closed().openings().caps;
}

/// Whether winding numbers may cancel each other inside solids. In a mesh that is not closed, the outward side of its
/// parts is a guess: parts that were tessellated separately next to a loose sheet may be oriented against each other.
bool mayMissSolids(const PooledMesh& pooled) {
  return !pooled.voxels && !pooled.quality.sign_trusted;
}

/// Whether winding numbers may also indicate a solid where there is none.
bool mayFillCavities(PooledMesh& pooled) {
  return mayMissSolids(pooled) && (pooled.quality.doubtful || capsOf(pooled).triangles.empty());
}

}  // namespace

Doubt doubtOf(const BodyDescription& description, MeshPool& pool) {
  Doubt doubt;
  TriangleMesh all;
  bool any = false;
  for (const GeometryDescription& geometry : description.geometry) {
    TriangleMesh part;
    if (const auto* primitive = std::get_if<Primitive>(&geometry.shape)) {
      if (isHalfSpace(*primitive)) continue;
      const AlignedBox3d box = boundingBox(*primitive);
      part = transformed(tessellate(Box::fromSize(box.sizes()), 1.0), Isometry3d(Eigen::Translation3d(box.center())));
    } else {
      PooledMesh& pooled = pool.find(geometry);
      any = any || mayMissSolids(pooled);
      doubt.of_inside = doubt.of_inside || mayFillCavities(pooled);
      part = pooled.voxels ? pooled.mesh : merged(pooled.mesh, capsOf(pooled));
    }
    all = merged(std::move(all), transformed(std::move(part), geometry.X_BG));
  }
  if (any) doubt.of_outside = std::make_shared<const TriangleTree>(all);
  return doubt;
}

}  // namespace sdf_ccd
