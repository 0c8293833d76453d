#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/weak_store.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// The mesh of equal content that is in use elsewhere, or else this one, which is found from now on; null if the store
/// has another mesh under that hash.
std::shared_ptr<const TriangleMesh> sharedMesh(WeakStore<TriangleMesh>& store, const std::string& hash,
                                               const std::shared_ptr<const TriangleMesh>& mesh);

/// Keys of geometry: equal for equal content, and only then. Meshes are hashed once, as long as they are referenced
/// elsewhere, and compared with the one in use under the same hash. Thread-safe; nobody waits while a mesh is hashed.
class GeometryKeys {
 public:
  /// Of a body in its own frame.
  std::string keyOf(const BodyDescription& body);

  /// Of one geometry, wherever it is in its body.
  std::string keyOf(const GeometryDescription& geometry);

 private:
  struct Known {
    std::weak_ptr<const TriangleMesh> mesh;
    std::string hash;
  };
  std::string hashOf(const std::shared_ptr<const TriangleMesh>& mesh);

  std::mutex mutex_;
  std::unordered_map<const TriangleMesh*, Known> hashes_;  // guarded by mutex_
};

/// Replaces meshes by meshes of equal content that are used elsewhere in this process and were passed here too.
void shareMeshes(std::vector<BodyDescription>& bodies);

}  // namespace sdf_ccd
