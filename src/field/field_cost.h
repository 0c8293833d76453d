#pragma once

#include "geometry/closed_solid.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd {

/// The expected cost of building a field, and its relative standard errors.
struct FieldCost {
  double bytes = 0.0;
  double seconds = 0.0;  ///< of processor time
  double bytes_error = 0.0;
  double seconds_error = 0.0;
};

/// Estimates the cost of buildField() with the same arguments by building a sample of the field's cells.
///
/// The sample is spread uniformly over the grid. It takes about 20 ms of the calling thread, or a thirtieth of the
/// estimated time if that is more; usually much less for small fields. Where single cells take long, the sample has few
/// cells and the errors are large. Every call takes the same sample, unless time ends it, and measures the time again.
/// @throws as buildField() for options that are not valid, or for a grid that exceeds a limit even without samples.
FieldCost expectedCost(const ClosedSolid& closed, const FieldOptions& options);

/// Its parts: of options with a max_error, and of those with cells of one size.
FieldCost expectedAdaptive(const Solid& solid, const FieldOptions& options);
FieldCost expectedUniform(const Solid& solid, const FieldOptions& options);

}  // namespace sdf_ccd
