#pragma once

#include <string>

namespace sdf_ccd {

/// Checks a COLLADA file for what assimp would leave out or make up without an error.
/// @return its unit [m]; 1 if it names none.
/// @throws std::runtime_error if it is not well-formed XML, if the unit is not a positive number, if numbers, names of
/// coordinates or targets of instances are missing or damaged, or for holes in polygons, triangle fans, skewed nodes,
/// and turns about an axis that has not length 1.
double checkCollada(const std::string& xml);

}  // namespace sdf_ccd
