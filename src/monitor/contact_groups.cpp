#include "contact_groups.h"

#include <map>
#include <string_view>

namespace sdf_ccd {
namespace {

std::string keyOf(const Body& body) {
  return body.map.empty() ? "b" + body.name : "m" + body.map;
}

}  // namespace

ContactGroups groupsOf(const Scene& scene) {
  const std::size_t count = scene.pairs.size();
  ContactGroups groups;
  groups.of_pair.reserve(count);
  std::vector<std::string> key_of_body;
  key_of_body.reserve(scene.bodies.size());
  for (const Body& body : scene.bodies) key_of_body.push_back(keyOf(body));
  std::map<std::pair<std::string_view, std::string_view>, int> of_maps;
  for (const PlannedPair& pair : scene.pairs) {
    const auto a = static_cast<std::size_t>(pair.body_a), b = static_cast<std::size_t>(pair.body_b);
    const auto next = static_cast<int>(groups.keys.size());
    const bool has_tile = !scene.bodies[a].map.empty() || !scene.bodies[b].map.empty();
    const int group = has_tile ? of_maps.try_emplace({key_of_body[a], key_of_body[b]}, next).first->second : next;
    if (group == next) groups.keys.emplace_back(key_of_body[a], key_of_body[b]);
    groups.of_pair.push_back(group);
  }
  groups.begin.assign(groups.keys.size() + 1, 0);
  for (const int group : groups.of_pair) ++groups.begin[static_cast<std::size_t>(group) + 1];
  for (std::size_t g = 1; g < groups.begin.size(); ++g) groups.begin[g] += groups.begin[g - 1];
  groups.pairs.resize(count);
  std::vector<int> filled(groups.begin.begin(), groups.begin.end() - 1);
  for (std::size_t p = 0; p < count; ++p)
    groups.pairs[static_cast<std::size_t>(filled[static_cast<std::size_t>(groups.of_pair[p])]++)] = static_cast<int>(p);
  return groups;
}

}  // namespace sdf_ccd
