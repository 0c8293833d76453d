#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// Groups of pairs whose contacts are tracked as one: a pair of bodies each, or all pairs of a body, or map, with the
/// tiles of a map.
struct ContactGroups {
  std::vector<std::pair<std::string, std::string>> keys;  ///< per group: of its bodies, or body and map
  std::vector<int> of_pair;                               ///< per pair of the scene
  std::vector<int> begin;                                 ///< per group, plus one: first index in `pairs`
  std::vector<int> pairs;                                 ///< group by group
};

/// A key is a letter that tells bodies from maps, as both may have one name, then the name.
ContactGroups groupsOf(const Scene& scene);

}  // namespace sdf_ccd
