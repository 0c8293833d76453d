#pragma once

#include "sdf_ccd/body/prepare_body.h"

namespace sdf_ccd {

/// Sets a resolution of fields that does not follow the elements' sizes.
/// @param field  also replaces the band and the limit of memory.
void setFieldResolution(const FieldOptions& field, BodyOptions& options);

/// Sets a spacing of shell points [m] that does not follow the elements' sizes, and that of mesh vertices.
void setShellSpacing(double spacing, BodyOptions& options);

}  // namespace sdf_ccd
