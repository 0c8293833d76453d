#pragma once

#include <string>
#include <vector>

#include <tinyxml2.h>

namespace sdf_ccd {

/// Where a link's text says that it has a collision shape, or places one, and urdfdom ignores that without an error:
/// at an element of another case, at another place, the second where there can be one, or with unknown attributes that
/// place it. Empty if it reads all.
std::string unreadShape(const tinyxml2::XMLElement& link);

/// The same for shapes that are in no link of the robot, which belong to no body: a line each, for the first ten.
/// @param robot  the document's first <robot>.
std::vector<std::string> shapesOutsideLinks(const tinyxml2::XMLElement& robot);

}  // namespace sdf_ccd
