#pragma once

#include <memory>
#include <string>
#include <vector>

#include <urdf_model/model.h>

namespace sdf_ccd {

/// urdfdom's parser, with its messages in the exception instead of on the console.
/// @throws std::runtime_error if the text is no URDF, or has more than 10,000 links.
/// @param warnings  gets a line for each pair of limits in the wrong order, which are exchanged, and for each of
/// misplacedElements() and makeTree(); and one if macros of xacro were not expanded.
std::shared_ptr<urdf::ModelInterface> parseUrdf(const std::string& xml, std::vector<std::string>& warnings);

/// All messages of urdfdom's parser about a text, also if it returns a model.
std::string urdfErrors(const std::string& xml);

}  // namespace sdf_ccd
