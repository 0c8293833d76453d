#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "study_fields.h"

namespace sdf_ccd::benchmark {

/// A distance field built by one of the systems.
struct BuiltField {
  std::size_t bytes;
  std::function<double(const Vector3d&)> distance;  ///< interpolated [m]
  double band;                                      ///< the samples are exact distances up to this |φ| [m]
  bool beyond_band;                                 ///< whether it also returns distances beyond the band
  std::function<void(const std::string& path)> save;
};

/// A system that builds and saves fields, and loads one and queries it once.
struct FieldBuilder {
  std::string name;
  std::function<bool(const StudyField&)> builds;
  std::function<std::shared_ptr<const BuiltField>(const TriangleMesh&, const StudyField&)> build;
  std::function<void(const std::string& path, const Vector3d& p)> load;
};

/// All builders. Each is in a file of its own that registers it here before main().
inline std::vector<FieldBuilder>& fieldBuilders() {
  static std::vector<FieldBuilder> builders;
  return builders;
}

struct RegisteredBuilder {
  explicit RegisteredBuilder(FieldBuilder builder) { fieldBuilders().push_back(std::move(builder)); }
};

}  // namespace sdf_ccd::benchmark
