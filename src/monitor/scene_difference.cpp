#include "scene_difference.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace sdf_ccd {
namespace {

std::uint64_t keyOf(int a, int b) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 | static_cast<std::uint32_t>(b);
}

bool sameTests(const PlannedPair& a, const PlannedPair& b) {
  return a.a_shell_b_field == b.a_shell_b_field && a.b_shell_a_field == b.b_shell_a_field;
}

}  // namespace

SceneDifference::SceneDifference(const Scene& before, const Scene& now) {
  std::unordered_map<const Body*, int> known;
  for (std::size_t b = 0; b < before.bodies.size(); ++b) known[before.bodies.shared(b).get()] = static_cast<int>(b);
  for (std::size_t b = 0; b < now.bodies.size(); ++b) {
    const auto found = known.find(now.bodies.shared(b).get());
    bodies_before_.push_back(found == known.end() ? -1 : found->second);
  }
  std::unordered_map<std::uint64_t, int> pairs;
  pairs.reserve(now.pairs.size());
  for (std::size_t p = 0; p < now.pairs.size(); ++p) {
    const int a = bodies_before_[static_cast<std::size_t>(now.pairs[p].body_a)];
    const int b = bodies_before_[static_cast<std::size_t>(now.pairs[p].body_b)];
    if (a >= 0 && b >= 0) pairs.emplace(keyOf(a, b), static_cast<int>(p));
  }
  pairs_now_.assign(before.pairs.size(), -1);
  std::vector<char> is_new(now.pairs.size(), 1);
  for (std::size_t p = 0; p < before.pairs.size(); ++p) {
    const PlannedPair& pair = before.pairs[p];
    const auto found = pairs.find(keyOf(pair.body_a, pair.body_b));
    if (found == pairs.end() || !sameTests(pair, now.pairs[static_cast<std::size_t>(found->second)])) continue;
    pairs_now_[p] = found->second;
    is_new[static_cast<std::size_t>(found->second)] = 0;
  }
  for (std::size_t p = 0; p < is_new.size(); ++p)
    if (is_new[p] != 0) new_pairs_.push_back(static_cast<int>(p));
}

std::vector<std::pair<std::string, std::string>> pairNames(const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> names;
  names.reserve(scene.pairs.size());
  for (const PlannedPair& pair : scene.pairs)
    names.emplace_back(scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name);
  return names;
}

std::vector<int> findPairs(const std::vector<std::pair<std::string, std::string>>& pairs,
                           const std::vector<std::pair<std::string, std::string>>& others) {
  std::unordered_map<std::string, int> bodies;  // numbered in the order of appearance
  const auto keyOfNames = [&](const std::pair<std::string, std::string>& names) {
    const int a = bodies.try_emplace(names.first, static_cast<int>(bodies.size())).first->second;
    const int b = bodies.try_emplace(names.second, static_cast<int>(bodies.size())).first->second;
    return keyOf(std::min(a, b), std::max(a, b));
  };
  std::unordered_map<std::uint64_t, int> indices;
  indices.reserve(others.size());
  for (std::size_t i = 0; i < others.size(); ++i) indices[keyOfNames(others[i])] = static_cast<int>(i);
  std::vector<int> found;
  found.reserve(pairs.size());
  for (const auto& names : pairs) {
    const auto index = indices.find(keyOfNames(names));
    found.push_back(index == indices.end() ? -1 : index->second);
  }
  return found;
}

}  // namespace sdf_ccd
