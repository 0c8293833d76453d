#pragma once

#include <algorithm>

#include "sdf_ccd/body/prepare_body.h"

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

/// Whether fields, or shells, that would be too large are made coarser: if nobody has set their resolution.
///@{
inline bool mayFieldBeCoarser(const BodyOptions& options) {
  return options.divides_max_error || options.cells_across > 0.0;
}
inline bool mayShellBeCoarser(const BodyOptions& options) {
  return options.divides_max_error || options.points_across > 0.0;
}
///@}

}  // namespace sdf_ccd
