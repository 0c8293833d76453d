#pragma once

#include <optional>
#include <set>
#include <string>
#include <unordered_map>

#include "common/files/file_cache.h"
#include "common/time_limit.h"
#include "common/weak_store.h"
#include "scene/geometry_keys.h"
#include "sdf_ccd/body.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "shell/point_shell.h"
#include "solid/closed_solid.h"

namespace sdf_ccd {

struct BodyTriangles;
struct BuiltBody;
class DepthSolid;

/// What bodies of equal content share, for as long as one of them exists. Thread-safe.
struct SharedContent {
  WeakStore<BuiltBody> bodies;
  WeakStore<BodyTriangles> triangles;
  WeakStore<DepthSolid> solids;
};

/// A mesh of the scene and the data built from it.
struct PooledMesh {
  TriangleMesh mesh;  ///< oriented; voxels need no orientation
  bool voxels = false;
  std::optional<double> cell_size;  ///< of its field [m]; none: that of the scene's options
  MeshQuality quality;              ///< empty for voxels
  std::optional<DistanceField> field;
  MadeSolid made;                       ///< the solid, and the solid closed by caps
  std::optional<PointShell> shells[2];  ///< by whether the mesh is the only part of its body, or has siblings
};

/// Builds fields and shells of meshes, each once for all bodies that share the mesh (fingers, a second arm). Bodies
/// that are equal as a whole share everything, within a pool or, with BodyOptions::is_shared, within the process.
class MeshPool {
 public:
  explicit MeshPool(const BodyOptions& options) : options_(options), cache_(options.cache_directory) {}

  /// The mesh of this geometry's content. The reference stays valid.
  PooledMesh& find(const GeometryDescription& geometry);

  SharedContent& content();
  GeometryKeys& keys() { return keys_; }

  /// Calls work(), which prepares this body, and may take options.max_preparation_time.
  /// @throws TookTooLong if it takes longer, and at once if a body of the same meshes has; see withinSeconds().
  template <class Work>
  auto withinTime(const BodyDescription& body, const Work& work) {
    std::string meshes;
    for (const GeometryDescription& geometry : body.geometry) meshes += keys_.keyOf(geometry);
    if (late_.count(meshes) > 0) throw TookTooLong(tooLong());
    try {
      return withinSeconds(options_.max_preparation_time, tooLong(), work);
    } catch (const TookTooLong&) {
      late_.insert(meshes);
      throw;
    }
  }

  struct Made {
    bool now = false;  ///< false: it existed already, for another body
    CacheOutcome outcome;
  };
  /// If the options require more than a field or shell may cost, and allow a coarser one, a coarser one is built; the
  /// outcome's warning says so, in place of the cache's.
  Made makeField(PooledMesh& mesh, const Progress& progress);
  Made makeShell(PooledMesh& mesh, bool has_siblings);

 private:
  /// @throws std::invalid_argument for options that no field can have.
  FieldOptions fieldOptions(const PooledMesh& mesh) const;
  ShellOptions shellOptions(const PooledMesh& mesh, bool has_siblings) const;
  std::string tooLong() const;

  const BodyOptions options_;
  FileCache cache_;
  GeometryKeys keys_;
  SharedContent content_;
  std::unordered_map<std::string, PooledMesh> meshes_;  // by the geometry's key
  std::size_t field_bytes_ = 0;                         // of all fields
  std::set<std::string> late_;                          // keys of the geometry of bodies that took too long
};

}  // namespace sdf_ccd
