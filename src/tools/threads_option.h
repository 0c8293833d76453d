#pragma once

#include <memory>

#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

namespace sdf_ccd::tools {

/// The option --threads.
struct ThreadsOption {
  int threads = 0;  ///< 0: one per core

  void addTo(CLI::App& command);

  /// Limits the number of threads as long as the result exists. @throws std::invalid_argument if it is negative.
  std::unique_ptr<tbb::global_control> limit() const;
};

}  // namespace sdf_ccd::tools
