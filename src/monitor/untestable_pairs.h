#pragma once

#include <string>

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// Why a pair that is not haveSurfaces() is NOT_CHECKED, if nothing else is the reason.
extern const char* const kNotTestable;

/// Adds a warning to the scene, whose bodies must be set, that names the pairs that are never checked for that reason,
/// if there are any. @return the warning.
std::string warnOfUntestable(Scene& scene);

}  // namespace sdf_ccd
