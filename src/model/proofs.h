#pragma once

#include <string>

namespace sdf_ccd {

/// The reasons of AllowedPair that a proof backs (AllowedPair::proof).
///@{
inline constexpr const char* kOutOfReach = "out of reach";
inline constexpr const char* kRigidlyJoined = "rigidly joined";
///@}

/// Whether a pair is left out for one of these, and not because a rule of the user allows it to touch.
inline bool isProof(const std::string& reason) {
  return reason == kRigidlyJoined || reason == kOutOfReach;
}

}  // namespace sdf_ccd
