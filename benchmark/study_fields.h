#pragma once

#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sdf_ccd/field.h"
#include "study.h"

namespace sdf_ccd::benchmark {

/// A field of a study, named `<mesh>/<cells>` or `<mesh>/<error>`.
struct StudyField {
  std::string name;
  int cells;  ///< 0 for a field built to a maximum error
  FieldOptions options;
};

inline std::vector<StudyField> studyFields(const NamedMesh& named, const StudyOptions& options) {
  std::vector<StudyField> fields;
  for (const int cells : options.cells) {
    fields.push_back({named.name + "/" + std::to_string(cells), cells, {}});
    fields.back().options.cells = cells;
  }
  const double side = boundingBox(named.mesh).sizes().maxCoeff();
  for (const std::string& error : options.errors) {
    fields.push_back({named.name + "/" + error, 0, {}});
    fields.back().options.max_error = std::stod(error) * side;
  }
  return fields;
}

/// Builds the field and passes it to `use`. A field that would be too large is skipped, with a line on stderr.
inline void withField(const NamedMesh& named, const StudyField& wanted,
                      const std::function<void(const DistanceField&)>& use) {
  try {
    use(buildField(named.mesh, wanted.options));
  } catch (const std::length_error& error) {
    std::fprintf(stderr, "%s is left out: %s\n", wanted.name.c_str(), error.what());
  }
}

}  // namespace sdf_ccd::benchmark
