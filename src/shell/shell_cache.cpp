#include "shell/shell_cache.h"

#include <stdexcept>
#include <string>

#include "mesh/content_hash.h"
#include "sdf_ccd/field.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

/// Version of the options' meaning: incremented when the same options give another shell.
constexpr double kMeaning = 3;

}  // namespace

CachedShell cachedShell(const FileCache& cache, const SolidSource& source, const ShellOptions& options) {
  CachedShell cached;
  const std::string name = contentHash(source.mesh(), {options.spacing, options.edge_gap, double(options.has_siblings),
                                                       options.vertex_spacing, double(options.seed), kMeaning}) +
                           ".shell";
  const auto load = [&](const std::string& path) {
    cached.shell = loadShell(path, name);
    if (cached.shell.size() > options.max_points) {  // made with a larger limit
      throw std::length_error("the shell has " + std::to_string(cached.shell.size()) + " points, more than the " +
                              std::to_string(options.max_points) + " allowed");
    }
  };
  cached.outcome = cache.get(name, {load, [&] { cached.shell = sampleSurface(source.solid(), options); },
                                    [&](const std::string& path) { saveShell(cached.shell, path, name); }});
  return cached;
}

}  // namespace sdf_ccd
