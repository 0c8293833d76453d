#include "body/doubtful_surface.h"

#include "geometry/mesh_edges.h"

namespace sdf_ccd {
namespace {

/// Of a mesh whose faces only seem to meet, as findOpenings() tells; none of a closed one.
const TriangleMesh& capsOf(PooledMesh& pooled) {
  static const TriangleMesh kNone;
  return isClosed(pooled.mesh) ? kNone : SolidSource(pooled.mesh, pooled.made).closed().openings().caps;
}

bool isDoubtful(PooledMesh& pooled) {
  if (pooled.voxels || pooled.quality.sign_trusted) return false;
  return pooled.quality.doubtful || capsOf(pooled).triangles.empty();
}

}  // namespace

std::shared_ptr<const TriangleTree> doubtfulSurface(const BodyDescription& description, MeshPool& pool) {
  TriangleMesh all;
  bool any = false;
  for (const GeometryDescription& geometry : description.geometry) {
    TriangleMesh part;
    if (const auto* primitive = std::get_if<Primitive>(&geometry.shape)) {
      if (isHalfSpace(*primitive)) continue;
      const AlignedBox3d box = boundingBox(*primitive);
      part = transformed(tessellate(Box{0.5 * box.sizes()}, 1.0), Isometry3d(Eigen::Translation3d(box.center())));
    } else {
      PooledMesh& pooled = pool.find(geometry);
      any = any || isDoubtful(pooled);
      part = pooled.voxels ? pooled.mesh : merged(pooled.mesh, capsOf(pooled));
    }
    all = merged(std::move(all), transformed(std::move(part), geometry.X_BG));
  }
  return any ? std::make_shared<const TriangleTree>(all) : nullptr;
}

}  // namespace sdf_ccd
