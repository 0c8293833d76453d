#pragma once

#include <CLI/CLI.hpp>

#include "common/number_text.h"
#include "common/time_limit.h"

namespace sdf_ccd::tools {

/// The option --max-time.
struct TimeOption {
  double seconds = 60.0;

  void addTo(CLI::App& command) {
    command
        .add_option("--max-time", seconds, "Time that preparing a mesh, or a body of a robot, may take [s]; default 60")
        ->check(CLI::PositiveNumber);
  }

  /// Calls work(), which is all that is done with a mesh. @throws TookTooLong, naming the option.
  template <class Work>
  auto limit(const Work& work) const {
    return withinSeconds(seconds,
                         "preparing the mesh takes more than the " + shortText(seconds) +
                             " s of --max-time: it has too many triangles, too many that cross each other, or a "
                             "resolution too fine for it",
                         work);
  }
};

}  // namespace sdf_ccd::tools
