#pragma once

#include "geometry/closed_solid.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd {

/// The expected cost of building a field, with the standard errors relative to it.
struct FieldCost {
  double bytes = 0.0;
  double seconds = 0.0;  ///< of one processor
  double bytes_error = 0.0;
  double seconds_error = 0.0;
};

/// Estimates the cost of buildField() with the same arguments by building a sample of the field's cells.
///
/// The sample is spread uniformly over the grid and takes some 20 ms, or a thirtieth of the estimate if that is more,
/// of the calling thread; for small fields, mostly much less. If single cells take long the sample has few cells, and
/// the errors are large. Unless time ends it, the sample is the same in each call; the time that it takes is measured
/// anew.
/// @throws as buildField() for options that no field can have, or for a grid that exceeds the limit by itself.
FieldCost expectedCost(const ClosedSolid& closed, const FieldOptions& options);

}  // namespace sdf_ccd
