#pragma once

#include "sdf_ccd/field.h"

namespace sdf_ccd {

class ClosedSolid;
class Solid;

/// The options with a resolution. @throws as validate().
FieldOptions withResolution(FieldOptions options);

/// buildField() of a solid that exists.
DistanceField buildField(const Solid& solid, const FieldOptions& options, const Progress& progress = {});
/// The same for a solid whose openings are closed, with its caps.
DistanceField buildField(const ClosedSolid& closed, const FieldOptions& options, const Progress& progress = {});

}  // namespace sdf_ccd
