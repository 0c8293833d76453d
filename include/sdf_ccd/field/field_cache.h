#pragma once

#include <string>

#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd {

struct CachedField {
  DistanceField field;
  bool from_cache = false;
  std::string warning;  ///< a damaged file was rebuilt, or the directory cannot be used; empty if all went well
};

/// Fields kept on disk, named by a hash of the mesh's content (scale included) and of the options.
///
/// Safe against several processes: whoever comes second waits for the first and loads what it built. A file that is
/// damaged or of another version is built again; a directory that cannot be written costs only the saving.
class FieldCache {
 public:
  /// @param directory  made if it does not exist; empty: nothing is read or written.
  explicit FieldCache(std::string directory);

  /// As buildField(), but from the cache where it is there.
  CachedField fieldFor(const TriangleMesh& mesh, const FieldOptions& options, const Progress& progress = {}) const;

  /// File that fieldFor() uses, without its directory.
  static std::string fileName(const TriangleMesh& mesh, const FieldOptions& options);

 private:
  std::string directory_;
};

}  // namespace sdf_ccd
