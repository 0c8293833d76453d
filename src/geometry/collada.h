#pragma once

#include <string>

namespace sdf_ccd {

/// Metres per unit of a COLLADA document: `<asset><unit meter="…">`, 1 where it says nothing.
///
/// Also refuses what assimp's reader does not survive: a list of indices that holds anything but numbers (it never
/// gets past that), arrays that are read beyond their end (assimp issue 6878), and nodes that contain themselves.
/// @throws std::runtime_error if the document is not well-formed, one of those, or its unit no positive number.
double inspectCollada(const std::string& xml);

}  // namespace sdf_ccd
