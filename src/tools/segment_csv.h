#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/segments.h"

namespace sdf_ccd::tools {

/// Reads lines `ox,oy,oz,ex,ey,ez` [m]: start and end of a segment. A first line with these names is skipped as a
/// header; blank lines are skipped.
/// @throws std::runtime_error naming file, line and value: not six numbers, one that is not finite, a segment that
/// reaches farther than 1e12 m, no segment at all.
std::vector<Segment> readSegments(const std::string& path);

}  // namespace sdf_ccd::tools
