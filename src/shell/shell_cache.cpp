#include "sdf_ccd/shell/shell_cache.h"

#include "sdf_ccd/field/content_hash.h"
#include "sdf_ccd/shell/shell_file.h"

namespace sdf_ccd {

CachedShell cachedShell(const FileCache& cache, const TriangleMesh& mesh, const ShellOptions& options) {
  CachedShell cached;
  const std::string name = contentHash(mesh, {options.spacing, options.edge_gap, double(options.has_siblings),
                                              options.vertex_spacing, double(options.seed)}) +
                           ".shell";
  cached.outcome = cache.get(name, {[&](const std::string& path) { cached.shell = loadShell(path); },
                                    [&] { cached.shell = sampleSurface(mesh, options); },
                                    [&](const std::string& path) { saveShell(cached.shell, path); }});
  return cached;
}

}  // namespace sdf_ccd
