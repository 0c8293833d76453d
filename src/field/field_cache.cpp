#include "sdf_ccd/field/field_cache.h"

#include <optional>

#include "sdf_ccd/field/content_hash.h"
#include "sdf_ccd/field/field_file.h"

namespace sdf_ccd {

namespace {

/// Counts what the same options have meant: a field of an earlier meaning must not be taken for one of today's.
constexpr double kMeaning = 3;

}  // namespace

std::string fieldFileName(const TriangleMesh& mesh, const FieldOptions& options) {
  return contentHash(mesh, {double(options.cells.value_or(0)), options.cell_size.value_or(0.0),
                            options.max_error.value_or(0.0), options.band, double(options.sample_bits), kMeaning}) +
         ".field";
}

CachedField cachedField(const FileCache& cache, const TriangleMesh& mesh, const FieldOptions& options,
                        const Progress& progress) {
  validate(mesh);
  validate(options);
  std::optional<DistanceField> field;
  const CacheOutcome outcome =
      cache.get(fieldFileName(mesh, options), {[&](const std::string& path) { field = loadField(path); },
                                               [&] { field = buildField(mesh, options, progress); },
                                               [&](const std::string& path) { saveField(*field, path); }});
  return {std::move(*field), outcome};
}

}  // namespace sdf_ccd
