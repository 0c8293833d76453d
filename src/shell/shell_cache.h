#pragma once

#include "common/files/file_cache.h"
#include "sample_surface.h"
#include "shell/point_shell.h"
#include "solid/closed_solid.h"

namespace sdf_ccd {

struct CachedShell {
  PointShell shell;
  CacheOutcome outcome;
};

/// As sampleSurface(), but loaded from the cache if possible; the key is the mesh's content and the options.
/// The limit of points is not in the key, as it changes no shell: it applies to loaded ones, too.
CachedShell cachedShell(const FileCache& cache, const SolidSource& source, const ShellOptions& options);

}  // namespace sdf_ccd
