#pragma once

#include "sdf_ccd/scene/error_budget.h"
#include "sdf_ccd/scene/scene.h"

namespace sdf_ccd::test {

/// A scene's options as max_error [m] alone sets them.
inline SceneOptions knob(double max_error) {
  const ErrorBudget budget = shareOut(max_error);
  SceneOptions options;
  options.field.max_error = budget.field;
  options.shell.spacing = budget.face_spacing;
  options.shell.edge_gap = budget.edge_gap;
  options.motion_margin = ErrorBudget::kChords * budget.chord_tolerance;
  options.max_error = max_error;
  return options;
}

}  // namespace sdf_ccd::test
