#include "body_options.h"
#include "scene/error_budget.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {

void setFieldResolution(const FieldOptions& field, BodyOptions& options) {
  options.cells_across = 0.0;
  options.field = field;
}

void setShellSpacing(double spacing, BodyOptions& options) {
  constexpr double kVertices = 0.4;  // of the spacing
  options.points_across = 0.0;
  options.shell.spacing = spacing;
  options.shell.vertex_spacing = kVertices * spacing;
}

ShellOptions shellForField(double field_error) {
  constexpr double kTwoCells = 2.3;  // in a uniform grid's error bounds
  ShellOptions options;
  options.spacing = kTwoCells * field_error;
  return options;
}

void setMotionErrors(double sampling, double chord_tolerance, BodyOptions& options) {
  options.motion_error = 2.0 * sampling;
  options.motion_margin = options.motion_error + chord_tolerance;
}

BodyOptions optionsForContacts(const std::optional<double>& accuracy) {
  constexpr double kCoarsest = 0.005;     // [m]
  constexpr double kPointsAcross = 25.0;  // the points of a robot's finger are then 2.5 mm apart
  constexpr double kCell = 1.2;           // of the spacing
  BodyOptions options;
  setShellSpacing(accuracy.value_or(kCoarsest), options);
  options.field.cell_size = kCell * options.shell.spacing;
  if (accuracy) return options;
  options.points_across = kPointsAcross;
  options.cells_across = kPointsAcross / kCell;
  options.shell.max_points = kMaxShellPoints;
  options.field.max_bytes = kMaxFieldBytes;
  return options;
}

BodyOptions optionsFor(const Accuracy& accuracy) {
  const ErrorBudget budget = divideErrorBudget(accuracy.max_error);
  BodyOptions options;
  options.field.max_error = budget.field;
  options.field.max_bytes = kMaxFieldBytes;
  options.shell.spacing = budget.face_spacing;
  options.shell.edge_gap = budget.edge_gap;
  options.shell.max_points = kMaxShellPoints;
  setMotionErrors(budget.chord_tolerance, budget.chord_tolerance, options);
  options.max_error = accuracy.max_error;
  options.divides_max_error = true;
  options.cache_directory = accuracy.cache_directory;
  return options;
}

}  // namespace sdf_ccd
