#pragma once

#include <tinyxml2.h>

namespace sdf_ccd {

/// Removes each <visual> without a shape from a link: it shows nothing, but urdfdom would stop reading the link there,
/// before its collision elements.
void removeEmptyVisuals(tinyxml2::XMLElement& link);

}  // namespace sdf_ccd
