#pragma once

#include <memory>
#include <string>
#include <vector>

#include <urdf_model/model.h>

namespace sdf_ccd {

/// urdfdom's parser, with its messages in the exception instead of on the console.
/// @throws std::runtime_error if the text is no URDF, or holds a joint that no kinematics can be made of.
/// @param warnings  limits in the wrong order, which are exchanged: a line each, added.
std::shared_ptr<urdf::ModelInterface> parseUrdf(const std::string& xml, std::vector<std::string>& warnings);

/// All that urdfdom's parser finds wrong with a text, also where it makes a model of it all the same.
std::string urdfErrors(const std::string& xml);

}  // namespace sdf_ccd
