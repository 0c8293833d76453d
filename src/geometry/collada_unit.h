#pragma once

#include <string>

namespace sdf_ccd {

/// Metres per unit of a COLLADA document: `<asset><unit meter="…">`, 1 where it says nothing.
/// @throws std::runtime_error if the unit is not a positive number.
double colladaUnit(const std::string& xml);

}  // namespace sdf_ccd
