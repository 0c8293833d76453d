#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "study_fields.h"

namespace sdf_ccd::benchmark {

/// A distance field that some system has built.
struct BuiltField {
  std::size_t bytes;
  std::function<double(const Vector3d&)> distance;  ///< interpolated [m]
  double band;                                      ///< |φ| up to which the samples are distances [m]
  bool beyond_band;                                 ///< true if it also says something farther away
  std::function<void(const std::string& path)> save;
};

/// A way to build fields, to save them, and to load one and ask it once.
struct FieldBuilder {
  std::string name;
  std::function<bool(const StudyField&)> builds;
  std::function<std::shared_ptr<const BuiltField>(const TriangleMesh&, const StudyField&)> build;
  std::function<void(const std::string& path, const Vector3d& p)> load;
};

/// Every builder is one file that adds itself here before main().
inline std::vector<FieldBuilder>& fieldBuilders() {
  static std::vector<FieldBuilder> builders;
  return builders;
}

struct RegisteredBuilder {
  explicit RegisteredBuilder(FieldBuilder builder) { fieldBuilders().push_back(std::move(builder)); }
};

}  // namespace sdf_ccd::benchmark
