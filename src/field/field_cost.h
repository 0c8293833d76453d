#pragma once

#include "geometry/closed_solid.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd {

/// What building a field is expected to take, with the standard errors of that, relative to it.
struct FieldCost {
  double bytes = 0.0;
  double seconds = 0.0;  ///< of one processor
  double bytes_error = 0.0;
  double seconds_error = 0.0;
};

/// Expects what buildField() takes with the same arguments, by building a sample of the field's cells.
///
/// The sample is spread evenly over the grid and takes some 20 ms, or a thirtieth of what is expected if that is more,
/// of the calling thread; of small fields, mostly much less. Where one cell alone takes long it has few cells, and the
/// errors say so. As long as time does not end it, it is the same in each call; the time that it takes is measured
/// anew.
/// @throws what buildField() throws for options that no field can have, or for a grid that is too large by itself.
FieldCost expectedCost(const ClosedSolid& closed, const FieldOptions& options);

}  // namespace sdf_ccd
