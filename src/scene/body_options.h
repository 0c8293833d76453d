#pragma once

#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Sets a resolution of fields that does not follow the elements' sizes.
/// @param field  also replaces the band and the limit of memory.
void setFieldResolution(const FieldOptions& field, BodyOptions& options);

/// Sets a spacing of shell points [m] that does not follow the elements' sizes, and that of mesh vertices.
void setShellSpacing(double spacing, BodyOptions& options);

/// The shell that goes with a field: its points are two cells of a uniform grid with this error bound [m] apart.
ShellOptions shellForField(double field_error);

/// Sets the errors of motions that the bands of fields allow for.
/// @param sampling         of each body's sampled motion [m].
/// @param chord_tolerance  ChordOptions::tolerance [m].
void setMotionErrors(double sampling, double chord_tolerance, BodyOptions& options);

}  // namespace sdf_ccd
