#pragma once

#include <functional>
#include <string>

#include "field/source_field.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd::tools {

/// Options of the shell that goes with a field of this error bound [m]. Empty: no shell.
using ShellOf = std::function<ShellOptions(double field_error)>;

/// The error bound of a field with these options, but for rounding [m].
double errorOf(const FieldOptions& options, const TriangleMesh& mesh);

/// Prints the expected cost of building a mesh's field and shell, if that is more than a second.
/// @param source  of the mesh.
/// @throws std::length_error beyond the monitor's limits, with an option that would fit.
void announceCost(const std::string& name, const TriangleMesh& mesh, const SolidSource& source,
                  const FieldOptions& field, const ShellOf& shell = {});

}  // namespace sdf_ccd::tools
