#pragma once

#include "oracle/scene_case.h"

/// Pairs whose fields and shells are too coarse to decide.
namespace sdf_ccd::test {

/// Shells with points centimetres apart.
inline BodyOptions coarse() {
  BodyOptions options = fine(0.02);
  options.field.cells = 16;
  return options;
}

/// Result for two bodies at rest, the first one at the origin.
inline PairResult at(Monitor& monitor, const Isometry3d& X) {
  monitor.reset();
  return monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(X)}), {}).pairs[0];
}

}  // namespace sdf_ccd::test
