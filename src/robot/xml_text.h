#pragma once

#include <string>

#include <tinyxml2.h>

namespace sdf_ccd {

/// Parses a URDF or SRDF; bytes that are no text become '?'.
/// @return its first <robot>.
/// @throws std::runtime_error with the line and the reason; if there is no <robot>, or the text is too large.
tinyxml2::XMLElement& parseRobotXml(const std::string& xml, tinyxml2::XMLDocument& document);

/// A warning of the first element or attribute that xacro should have replaced, as what it stands for is missing; empty
/// if there is none. Definitions do no harm.
/// @param kind  of the document: "URDF", "SRDF".
std::string unexpandedMacro(const tinyxml2::XMLElement& element, const std::string& kind);

}  // namespace sdf_ccd
