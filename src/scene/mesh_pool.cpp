#include "mesh_pool.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include "sdf_ccd/field/field_cache.h"
#include "sdf_ccd/shell/shell_cache.h"

namespace sdf_ccd {
namespace {

constexpr int kWidestBand = 32;  // cells

std::size_t contentHash(const TriangleMesh& mesh) {
  const std::hash<std::string_view> hash;
  const auto* vertices = reinterpret_cast<const char*>(mesh.vertices.data());
  const auto* triangles = reinterpret_cast<const char*>(mesh.triangles.data());
  return hash({vertices, mesh.vertices.size() * sizeof(Vector3d)}) * 31 +
         hash({triangles, mesh.triangles.size() * sizeof(Vector3i)});
}

}  // namespace

PooledMesh& MeshPool::find(const TriangleMesh& mesh, bool voxels) {
  const std::size_t hash = contentHash(mesh);
  const auto [first, last] = entries_.equal_range(hash);
  for (auto it = first; it != last; ++it) {
    const Entry& entry = *it->second;
    if (entry.pooled.voxels == voxels && entry.original.vertices == mesh.vertices &&
        entry.original.triangles == mesh.triangles)
      return it->second->pooled;
  }
  auto entry = std::make_unique<Entry>();
  entry->original = mesh;
  entry->pooled.voxels = voxels;
  if (voxels) {
    validate(mesh);
    entry->pooled.mesh = mesh;
  } else {
    OrientedMesh oriented = orientOutward(mesh);
    entry->pooled.mesh = std::move(oriented.mesh);
    entry->pooled.quality = oriented.quality;
  }
  return entries_.emplace(hash, std::move(entry))->second->pooled;
}

FieldOptions MeshPool::fieldOptions(const TriangleMesh& mesh) const {
  FieldOptions options = options_.field;
  validate(options);
  const double to_error = std::sqrt(3.0) / 2.0;  // of a cell's side (design §3.3)
  double cell = 0.0;
  if (options.cells) cell = boundingBox(mesh).sizes().maxCoeff() / *options.cells;
  if (options.cell_size) cell = *options.cell_size;
  if (options.max_error) cell = *options.max_error / to_error;
  const double margin = 1.1 * (options_.shell.spacing + to_error * cell + options_.motion_margin);
  options.band = std::max(options.band, std::min(margin, kWidestBand * cell));
  return options;
}

MeshPool::Made MeshPool::makeField(PooledMesh& mesh, const Progress& progress) {
  if (mesh.field) return {};
  CachedField made = cachedField(cache_, mesh.mesh, fieldOptions(mesh.mesh), progress);
  mesh.field = std::move(made.field);
  return {true, made.outcome};
}

MeshPool::Made MeshPool::makeShell(PooledMesh& mesh) {
  if (mesh.shell) return {};
  CachedShell made = cachedShell(cache_, mesh.mesh, options_.shell);
  mesh.shell = std::move(made.shell);
  return {true, made.outcome};
}

}  // namespace sdf_ccd
