#pragma once

#include <algorithm>

#include "sdf_ccd/body/body_options.h"

namespace sdf_ccd {

/// The options of one element's shell and field, of a surface of this area [m²]: BodyOptions::shell and field, or,
/// where they follow the element's size, finer.
/// @param is_large  whether the points of a large element may be farther apart than shell.spacing, too.
ShellOptions shellOptionsFor(const BodyOptions& options, double area, bool is_large = false);
FieldOptions fieldOptionsFor(const BodyOptions& options, double area);

/// The distance of a shell's points that says how many there are: along edges, if these are sampled apart [m].
inline double finenessOf(const ShellOptions& shell) {
  return shell.edge_gap > 0.0 ? shell.edge_gap : shell.spacing;
}
inline void setFineness(double fineness, ShellOptions& shell) {
  if (shell.edge_gap > 0.0) shell.edge_gap = fineness;
  shell.spacing = std::max(shell.spacing, fineness);
}

/// Whether what would be too large is made coarser.
inline bool mayBeCoarser(const BodyOptions& options) {
  return options.is_shared_out || options.points_across > 0.0;
}

}  // namespace sdf_ccd
