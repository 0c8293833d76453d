#include "body/element_options.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sdf_ccd {
namespace {

constexpr double kFinest = 1e-3;  // resolution by an element's size [m]

double across(double area, double count, double coarsest) {
  return std::min(coarsest, std::max(kFinest, std::sqrt(area) / count));
}

}  // namespace

ShellOptions shellOptionsFor(const BodyOptions& options, double area, bool is_large) {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  ShellOptions shell = options.shell;
  if (!(options.points_across > 0.0)) return shell;
  shell.spacing = across(area, options.points_across, is_large ? kNoLimit : shell.spacing);
  shell.vertex_spacing *= shell.spacing / options.shell.spacing;
  return shell;
}

FieldOptions fieldOptionsFor(const BodyOptions& options, double area) {
  FieldOptions field = options.field;
  if (options.cells_across > 0.0 && field.cell_size)
    field.cell_size = across(area, options.cells_across, *field.cell_size);
  return field;
}

}  // namespace sdf_ccd
