#pragma once

#include <optional>
#include <string>
#include <unordered_map>

#include "geometry/closed_solid.h"
#include "sdf_ccd/body/body_options.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "sdf_ccd/model/scene_description.h"
#include "storage/file_cache.h"

namespace sdf_ccd {

/// A mesh of the scene and what was made of it.
struct PooledMesh {
  TriangleMesh mesh;  ///< oriented, but for voxels, which are right as they come
  bool voxels = false;
  std::optional<double> cell_size;  ///< of its field [m]; none: as the scene's options say
  MeshQuality quality;              ///< empty for voxels
  std::optional<DistanceField> field;
  MadeSolid made;                       ///< the solid, and that closed by caps
  std::optional<PointShell> shells[2];  ///< of a body of its own, and beside siblings
};

/// Makes fields and shells of meshes, each once however many bodies have it (fingers, a second arm).
class MeshPool {
 public:
  explicit MeshPool(const BodyOptions& options) : options_(options), cache_(options.cache_directory) {}

  /// The mesh of this geometry's content. The reference stays valid.
  PooledMesh& find(const GeometryDescription& geometry);

  /// See BodyOptions.
  bool exactDepths() const { return options_.exact_depths; }
  bool isShared() const { return options_.is_shared; }

  struct Made {
    bool now = false;  ///< false: it was there already, for another body
    CacheOutcome outcome;
  };
  /// How the field of a mesh is made. @throws std::invalid_argument for options that no field can have.
  FieldOptions fieldOptions(const PooledMesh& mesh) const;
  ShellOptions shellOptions(const PooledMesh& mesh) const;

  /// Where the options ask for more than a field or shell may cost, and let it be coarser, a coarser one is made; the
  /// outcome's warning says so.
  Made makeField(PooledMesh& mesh, const Progress& progress);
  Made makeShell(PooledMesh& mesh, bool has_siblings);

 private:
  const BodyOptions options_;
  FileCache cache_;
  std::unordered_map<std::string, PooledMesh> meshes_;  // by the content's hash
};

}  // namespace sdf_ccd
