#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// Pairs of bodies, by patterns of their names: * stands for any text, ? for any character.
struct PairRule {
  std::string a, b;
};

/// The allowed collision matrix, as a user writes it. What is in both lists is checked.
struct PairRules {
  std::vector<PairRule> allowed;  ///< may touch, and are left out
  std::vector<PairRule> checked;  ///< are checked, unless nothing can bring them nearer to each other
};

bool isPattern(const std::string& text);
bool matches(const std::string& pattern, const std::string& name);

/// Either way round.
bool matches(const PairRule& rule, const std::string& name_a, const std::string& name_b);
bool matchesAny(const std::vector<PairRule>& rules, const std::string& name_a, const std::string& name_b);

/// Why a pair is left out by the rules: "allowed_pairs: hand* - table"; empty if it is not.
std::string whyAllowed(const PairRules& rules, const std::string& name_a, const std::string& name_b);

/// Leaves out pairs of a scene that are allowed to touch, and takes back what else left out pairs that are to be
/// checked, but for DisabledPair::proved ones.
/// @param scene     with all of its bodies and disabled pairs.
/// @param warnings  gets the patterns that no body's name matches.
void applyRules(const PairRules& rules, SceneDescription& scene, std::vector<std::string>& warnings);

}  // namespace sdf_ccd
