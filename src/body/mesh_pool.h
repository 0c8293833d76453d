#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>

#include "body/geometry_keys.h"
#include "common/seconds_since.h"
#include "common/time_limit.h"
#include "common/weak_store.h"
#include "geometry/closed_solid.h"
#include "sdf_ccd/body/prepare_body.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "sdf_ccd/model/scene_description.h"
#include "storage/file_cache.h"

namespace sdf_ccd {

struct BodyTriangles;
struct BuiltBody;

/// What bodies of equal content share, for as long as one of them exists. Thread-safe.
struct SharedContent {
  WeakStore<BuiltBody> bodies;
  WeakStore<BodyTriangles> triangles;
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

  /// See BodyOptions.
  bool exactDepths() const { return options_.exact_depths; }

  SharedContent& content();
  GeometryKeys& keys() { return keys_; }

  /// Calls work(), which is part of preparing this body. All of it together may take options.max_preparation_time.
  /// @throws TookTooLong if it takes longer, and at once if bodies of the same meshes have; see withinSeconds().
  template <class Work>
  auto withinTime(const BodyDescription& body, const Work& work) {
    TimeUsed& used = timeOf(body);
    const TimeUsed::Part part(used);
    return withinSeconds(std::max(0.0, options_.max_preparation_time - used.seconds), tooLong(), work);
  }

  /// Names of the cache's files that hold what was made or loaded.
  const std::set<std::string>& files() const { return files_; }

  struct Made {
    bool now = false;  ///< false: it existed already, for another body
    CacheOutcome outcome;
  };
  /// The options of the field of a mesh. @throws std::invalid_argument for options that no field can have.
  FieldOptions fieldOptions(const PooledMesh& mesh) const;
  ShellOptions shellOptions(const PooledMesh& mesh, bool has_siblings) const;

  /// If the options require more than a field or shell may cost, and allow a coarser one, a coarser one is built; the
  /// outcome's warning says so.
  Made makeField(PooledMesh& mesh, const Progress& progress);
  Made makeShell(PooledMesh& mesh, bool has_siblings);

 private:
  /// Of preparing bodies of the same meshes.
  struct TimeUsed {
    /// Adds its own lifetime.
    class Part {
     public:
      explicit Part(TimeUsed& used) : used_(used), start_(std::chrono::steady_clock::now()) {}
      ~Part() { used_.seconds += secondsSince(start_); }
      Part(const Part&) = delete;
      Part& operator=(const Part&) = delete;

     private:
      TimeUsed& used_;
      std::chrono::steady_clock::time_point start_;
    };

    double seconds = 0.0;
  };

  TimeUsed& timeOf(const BodyDescription& body);
  std::string tooLong() const;

  /// Notes the file. A warning of the pool replaces that of the cache.
  Made noted(CacheOutcome outcome, const std::string& warning);

  const BodyOptions options_;
  FileCache cache_;
  GeometryKeys keys_;
  SharedContent content_;
  std::unordered_map<std::string, PooledMesh> meshes_;  // by the geometry's key
  std::set<std::string> files_;
  std::unordered_map<std::string, TimeUsed> times_;  // by the keys of a body's geometry, wherever it is in the body
};

}  // namespace sdf_ccd
