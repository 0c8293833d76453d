#include "field/field_cache.h"

#include <cstdio>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "field/build_field.h"
#include "field/field_access.h"
#include "field/opening_caps.h"
#include "field/source_field.h"
#include "mesh/content_hash.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {

namespace {

/// Version of the options' meaning: incremented when the same options give another field.
constexpr double kMeaning = 6;

/// Suffix of the file that holds a field's warning.
constexpr const char* kDoubt = ".doubt";

/// Empty if there is no such file.
std::string firstLine(const std::string& path) {
  constexpr std::size_t kMaxBytes = 1000;
  char line[kMaxBytes] = "";
  std::ifstream(path).getline(line, sizeof line);
  return line;
}

}  // namespace

std::string fieldFileName(const TriangleMesh& mesh, const FieldOptions& options) {
  return contentHash(mesh, {double(options.cells.value_or(0)), options.cell_size.value_or(0.0),
                            options.max_error.value_or(0.0), options.band, kMeaning}) +
         ".field";
}

CachedField cachedField(const FileCache& cache, const SolidSource& source, const FieldOptions& given,
                        const Progress& progress) {
  validate(source.mesh());
  const FieldOptions options = withResolution(given);
  std::optional<DistanceField> field;
  std::string doubt;
  const std::string name = fieldFileName(source.mesh(), options);
  const auto load = [&](const std::string& path) {
    field = loadField(path, name);
    const std::size_t bytes =
        field->bytes() - (FieldAccess::openings(*field) ? FieldAccess::openings(*field)->bytes() : 0);
    if (bytes > options.max_bytes) {  // made with a larger limit
      throw std::length_error("field: " + std::to_string(bytes >> 20) + " MB, more than the " +
                              std::to_string(options.max_bytes >> 20) + " MB allowed");
    }
    doubt = firstLine(path + kDoubt);
  };
  const auto make = [&] {
    field = buildField(source, options, progress);
    if (!source.voxels()) doubt = warning(source.solid().report());
  };
  const auto save = [&](const std::string& path) {
    // Before the field, which is never read without it.
    std::remove((path + kDoubt).c_str());
    if (!doubt.empty() && !(std::ofstream(path + kDoubt) << doubt << std::endl))
      throw std::runtime_error(path + kDoubt + ": cannot be written");
    saveField(*field, path, name);
  };
  CacheOutcome outcome = cache.get(name, {load, make, save});
  if (!doubt.empty()) outcome.warning += (outcome.warning.empty() ? "" : "; ") + doubt;
  return {std::move(*field), outcome};
}

}  // namespace sdf_ccd
