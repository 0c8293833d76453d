#include "scene/geometry_keys.h"

#include <atomic>

#include "mesh/content_hash.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kHashes = 1024;

void append(const double* numbers, std::size_t count, std::string& key) {
  key.append(reinterpret_cast<const char*>(numbers), count * sizeof(double));
}

struct AppendSizes {
  std::string& key;
  void operator()(const Sphere& sphere) const { append(&sphere.radius, 1, key); }
  void operator()(const Box& box) const { append(box.size.data(), 3, key); }
  void operator()(const Cylinder& cylinder) const {
    append(&cylinder.radius, 1, key);
    append(&cylinder.length, 1, key);
  }
  void operator()(const HalfSpace& half_space) const {
    append(half_space.normal.data(), 3, key);
    append(&half_space.offset, 1, key);
  }
};

WeakStore<TriangleMesh>& meshesInUse() {
  static WeakStore<TriangleMesh> of_process;
  return of_process;
}

}  // namespace

std::shared_ptr<const TriangleMesh> sharedMesh(WeakStore<TriangleMesh>& store, const std::string& hash,
                                               const std::shared_ptr<const TriangleMesh>& mesh) {
  const std::shared_ptr<const TriangleMesh> kept = store.keep(hash, mesh);
  return kept == mesh || areIdentical(*kept, *mesh) ? kept : nullptr;
}

std::string GeometryKeys::hashOf(const std::shared_ptr<const TriangleMesh>& mesh) {
  static std::atomic<std::uint64_t> others{0};
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = hashes_.find(mesh.get());
    if (known != hashes_.end() && known->second.mesh.lock() == mesh) return known->second.hash;
  }
  std::string hash = contentHash(*mesh, {});
  if (!sharedMesh(meshesInUse(), hash, mesh)) hash += "/" + std::to_string(++others);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (hashes_.size() > kHashes) {
    for (auto known = hashes_.begin(); known != hashes_.end();)
      known = known->second.mesh.expired() ? hashes_.erase(known) : std::next(known);
  }
  hashes_[mesh.get()] = {mesh, hash};
  return hash;
}

std::string GeometryKeys::keyOf(const GeometryDescription& geometry) {
  std::string key(1, static_cast<char>('0' + geometry.shape.index()));
  if (const auto* primitive = std::get_if<Primitive>(&geometry.shape)) {
    key += static_cast<char>('0' + primitive->index());
    std::visit(AppendSizes{key}, *primitive);
  } else {
    const auto& mesh = std::get<std::shared_ptr<const TriangleMesh>>(geometry.shape);
    key += mesh ? hashOf(mesh) : "none";
  }
  key += geometry.watertight_voxels ? 'v' : '-';
  key += geometry.cell_size ? 'c' : '-';
  if (geometry.cell_size) append(&*geometry.cell_size, 1, key);
  return key;
}

std::string GeometryKeys::keyOf(const BodyDescription& body) {
  std::string key;
  for (const GeometryDescription& geometry : body.geometry) {
    key += keyOf(geometry);
    append(geometry.X_BG.data(), 16, key);
  }
  return key;
}

void shareMeshes(std::vector<BodyDescription>& bodies) {
  for (BodyDescription& body : bodies) {
    for (GeometryDescription& geometry : body.geometry) {
      auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
      if (!mesh || !*mesh) continue;
      if (auto shared = sharedMesh(meshesInUse(), contentHash(**mesh, {}), *mesh)) *mesh = std::move(shared);
    }
  }
}

}  // namespace sdf_ccd
