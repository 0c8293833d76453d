#pragma once

#include <string>
#include <vector>

#include <tinyxml2.h>

namespace sdf_ccd {

/// The first element of a link that urdfdom ignores without an error though it is, or places, a collision shape: one
/// whose name has the wrong case or is SDFormat's, at a wrong place, or the second where there can be one; or an
/// <origin> that is placed by unknown attributes. Empty if there is none.
std::string misplacedShape(const tinyxml2::XMLElement& link);

/// The same for elements of the robot itself, of its joints, and others of its links than shapes; for links and joints
/// below elements that urdfdom does not know; and for a second robot, also beside the first. A line each, for the first
/// ten.
/// @param robot  the document's first <robot>.
std::vector<std::string> misplacedElements(const tinyxml2::XMLElement& robot);

}  // namespace sdf_ccd
