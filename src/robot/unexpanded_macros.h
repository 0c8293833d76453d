#pragma once

#include <string>

#include <tinyxml2.h>

namespace sdf_ccd {

/// A warning of macros and expressions of xacro that were not expanded; empty if there are none. Other readers ignore
/// them, too; but what they stand for is missing. Definitions do no harm.
/// @param kind  of the document: "URDF", "SRDF".
std::string unexpandedMacros(const tinyxml2::XMLDocument& document, const std::string& kind);

}  // namespace sdf_ccd
