#pragma once

#include <string>
#include <vector>

namespace sdf_ccd {

/// A hint for the user if tf knows none of a robot's frames, but one of them behind a prefix: "tf has tb1/base_link: is
/// tf_prefix tb1?". Empty otherwise.
std::string prefixHint(const std::vector<std::string>& frames, const std::vector<std::string>& known);

}  // namespace sdf_ccd
