#pragma once

#include <algorithm>

#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// How a resolution that follows an element's size grows on, beyond that of the options.
enum class Growth {
  kSlow,  ///< by the fourth root: what touches a large element is larger, but not in proportion. Of meshes
  kFull,  ///< in proportion: of a primitive, whose field is exact
};

/// The options of the shell and field of one element with this surface area [m²]: BodyOptions::shell and field, or,
/// if they follow the element's size, finer or coarser ones.
ShellOptions shellOptionsFor(const BodyOptions& options, double area, Growth growth);
FieldOptions fieldOptionsFor(const BodyOptions& options, double area);

/// The spacing that determines the number of a shell's points: that of edges, if these are sampled separately [m].
inline double finenessOf(const ShellOptions& shell) {
  return shell.edge_gap > 0.0 ? shell.edge_gap : shell.spacing;
}
inline void setFineness(double fineness, ShellOptions& shell) {
  if (shell.edge_gap > 0.0) shell.edge_gap = fineness;
  shell.spacing = std::max(shell.spacing, fineness);
}

/// How many times coarser a field, or shell, that would be too large may be made: 1 if somebody has set its resolution,
/// and not much where it is a share of max_error, which would be missed by far.
///@{
inline double coarsestField(const BodyOptions& options) {
  return options.divides_max_error ? 2.0 : options.cells_across > 0.0 ? 1e3 : 1.0;
}
inline double coarsestShell(const BodyOptions& options) {
  return options.divides_max_error ? 2.0 : options.points_across > 0.0 ? 1e3 : 1.0;
}
///@}

}  // namespace sdf_ccd
