#pragma once

#include <string>

#include "common/files/file_cache.h"
#include "sdf_ccd/field.h"
#include "solid/closed_solid.h"

namespace sdf_ccd {

struct CachedField {
  DistanceField field;
  CacheOutcome outcome;
};

/// As buildField(), but loaded from the cache if possible; the key is the mesh's content (scale included) and the
/// options. The limit of bytes is not in the key, as it changes no field: it applies to loaded ones, too. The outcome's
/// warning says where depths may be those of faces inside the solid; a second file stores it.
CachedField cachedField(const FileCache& cache, const SolidSource& source, const FieldOptions& options,
                        const Progress& progress = {});

/// Name of the file that cachedField() uses.
std::string fieldFileName(const TriangleMesh& mesh, const FieldOptions& options);

}  // namespace sdf_ccd
