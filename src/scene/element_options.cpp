#include "scene/element_options.h"
#include "sdf_ccd/field.h"

#include <algorithm>
#include <cmath>

namespace sdf_ccd {
namespace {

double across(double area, double count, double usual, Growth growth) {
  constexpr double kFinest = 1e-3, kSlowly = 0.25;
  const double resolution = std::max(kFinest, std::sqrt(area) / count);
  if (resolution <= usual || growth == Growth::kFull) return resolution;
  return usual * std::pow(resolution / usual, kSlowly);
}

}  // namespace

ShellOptions shellOptionsFor(const BodyOptions& options, double area, Growth growth) {
  ShellOptions shell = options.shell;
  if (!(options.points_across > 0.0)) return shell;
  shell.spacing = across(area, options.points_across, shell.spacing, growth);
  shell.vertex_spacing *= shell.spacing / options.shell.spacing;
  return shell;
}

FieldOptions fieldOptionsFor(const BodyOptions& options, double area) {
  FieldOptions field = options.field;
  if (options.cells_across > 0.0 && field.cell_size)
    field.cell_size = across(area, options.cells_across, *field.cell_size, Growth::kSlow);
  return field;
}

}  // namespace sdf_ccd
