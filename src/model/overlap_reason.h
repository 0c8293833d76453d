#pragma once

#include <string>

namespace sdf_ccd {

/// Why a pair is left out that overlaps at rest and in random states: "overlap at rest, 5.57 mm, and ...".
/// @param depth  at rest [m]; 0 if it is not known.
/// @param others  what holds in the random states.
std::string overlapReason(double depth, const std::string& others);

/// A reason that many pairs share, and what it says of one of them.
struct SharedReason {
  std::string text;
  std::string depth;  ///< "5.57 mm"; empty if the reason has none
};

/// Takes the depth out of what overlapReason() returned; any other reason stays as it is.
SharedReason sharedReason(const std::string& reason);

}  // namespace sdf_ccd
