#pragma once

#include <string>

#include <tinyxml2.h>

namespace sdf_ccd {

/// The name of a URDF's link; "unnamed link of line 12" if it has none, which the parser refuses.
std::string linkName(const tinyxml2::XMLElement& link);

/// Changes a URDF's link so that urdfdom reads all of its collision shapes: it stops at the first element that it does
/// not know, also where nothing here depends on it.
///  - A capsule becomes a cylinder and two spheres, whose union it is. `length` is that of the cylinder, as for
///    SDFormat, Drake and PyBullet.
///  - Of all <visual> one shape stays, if one of them has any; <inertial> goes.
void makeReadable(tinyxml2::XMLElement& link);

}  // namespace sdf_ccd
