#pragma once

#include <string>
#include <utility>

namespace sdf_ccd {

/// Two bodies or links by their names, independent of the order.
using NamePair = std::pair<std::string, std::string>;

inline NamePair namePair(const std::string& a, const std::string& b) {
  return a < b ? NamePair(a, b) : NamePair(b, a);
}

}  // namespace sdf_ccd
