#include "sdf_ccd/body/body_options.h"

#include "model/error_budget.h"

namespace sdf_ccd {

BodyOptions optionsFor(const Accuracy& accuracy) {
  const ErrorBudget budget = shareOut(accuracy.max_error);
  BodyOptions options;
  options.field.max_error = budget.field;
  options.field.max_bytes = kMostFieldBytes;
  options.shell.spacing = budget.face_spacing;
  options.shell.edge_gap = budget.edge_gap;
  options.shell.max_points = kMostShellPoints;
  options.motion_margin = ErrorBudget::kChords * budget.chord_tolerance;
  options.max_error = accuracy.max_error;
  options.cache_directory = accuracy.cache_directory;
  return options;
}

}  // namespace sdf_ccd
