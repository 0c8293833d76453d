#pragma once

#include <map>
#include <string>

#include <urdf_model/model.h>

namespace sdf_ccd {

/// Links that have fewer collision shapes in the model than in the text, or have them elsewhere, and why: urdfdom stops
/// reading a link at the first collision element that it cannot parse, continues with the next link without an error,
/// and ignores elements that it does not expect (misplacedShape()). Of two links with one name only the first is read.
/// @param xml  the text that the model was parsed from.
/// @return reasons by link.
/// @throws std::runtime_error if the text cannot be read again.
std::map<std::string, std::string> unreadLinks(const urdf::ModelInterface& model, const std::string& xml);

}  // namespace sdf_ccd
