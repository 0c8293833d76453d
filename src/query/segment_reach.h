#pragma once

#include <stdexcept>
#include <string>

#include "sdf_ccd/segments.h"

namespace sdf_ccd {

/// Refuses a segment that is not within reach. @param what  names the segment.
[[noreturn]] inline void failOutOfReach(const std::string& what) {
  throw std::invalid_argument(what + " is not finite or has a coordinate above 1e12 m");
}

/// @throws std::invalid_argument if the segment is not within reach; see isWithinReach(). @param query  that wants it.
inline void requireWithinReach(const Segment& segment, const char* query) {
  if (!isWithinReach(segment)) failOutOfReach(std::string(query) + ": the segment");
}

}  // namespace sdf_ccd
