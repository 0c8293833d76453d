#pragma once

#include <string>
#include <utility>

namespace sdf_ccd {

/// Two bodies or links by their names, independent of the order.
using NamePair = std::pair<std::string, std::string>;

inline NamePair namePair(const std::string& a, const std::string& b) {
  return a < b ? NamePair(a, b) : NamePair(b, a);
}

/// As messages name a pair: "a - b".
inline std::string pairName(const std::string& a, const std::string& b) {
  return a + " - " + b;
}

/// @param pair  of bodies by index, which `scene` has.
template <class Scene, class Pair>
std::string pairName(const Scene& scene, const Pair& pair) {
  return pairName(scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name);
}

}  // namespace sdf_ccd
