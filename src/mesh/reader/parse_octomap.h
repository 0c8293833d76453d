#pragma once

#include <cstdint>
#include <string>

#include "mesh/import/read_apart.h"

namespace sdf_ccd {

/// Extracts the surface of an OctoMap in the calling process, unprotected: only for the confined program sdf_ccd_read
/// and for fuzzing. All other code calls loadOctomapSurface(), which runs that program.
/// @param max_memory  upper bound of the surface's memory [bytes]; the faces are counted before they are created.
/// @throws std::exception with the reason.
ReadMesh parseOctomapUnconfined(const std::string& bytes, std::uint64_t max_memory);

}  // namespace sdf_ccd
