#pragma once

#include <cstdint>
#include <string>

#include "import/read_apart.h"

namespace sdf_ccd {

/// Makes the surface of an OctoMap in this very process: for the program sdf_ccd_read, which is confined, and for
/// fuzzing. All else calls loadOctomapSurface(), which has that program do it.
/// @param max_memory  that the surface may take [bytes]; it is counted before it is made.
/// @throws std::exception with the reason.
ReadMesh parseOctomapHere(const std::string& bytes, std::uint64_t max_memory);

}  // namespace sdf_ccd
