#include "ros/tf/prefix_hint.h"

#include <algorithm>
#include <set>

namespace sdf_ccd {

std::string prefixHint(const std::vector<std::string>& frames, const std::vector<std::string>& known) {
  const std::set<std::string> wanted(frames.begin(), frames.end());
  const auto isWanted = [&](const std::string& name) { return wanted.count(name) > 0; };
  if (std::any_of(known.begin(), known.end(), isWanted)) return {};
  for (const std::string& name : known) {
    for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
      if (isWanted(name.substr(slash + 1))) return "tf has " + name + ": is tf_prefix " + name.substr(0, slash) + "?";
    }
  }
  return {};
}

}  // namespace sdf_ccd
