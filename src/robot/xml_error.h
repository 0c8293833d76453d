#pragma once

#include <string>

namespace tinyxml2 {
class XMLDocument;
}

namespace sdf_ccd {

/// Why a document could not be parsed, in words: "line 3: a tag does not match the one that it closes".
std::string xmlError(const tinyxml2::XMLDocument& document);

}  // namespace sdf_ccd
