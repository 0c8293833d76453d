#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Pairs of bodies, by patterns of their names: * stands for any text, ? for any character.
struct PairRule {
  std::string a, b;
};

/// The allowed collision matrix, as written by a user. Pairs in both lists are checked.
struct PairRules {
  std::vector<PairRule> allowed;  ///< may touch: not checked
  std::vector<PairRule> checked;  ///< checked, unless they are rigidly joined
};

bool isPattern(const std::string& text);
bool matches(const std::string& pattern, const std::string& name);

/// In either order.
bool matches(const PairRule& rule, const std::string& name_a, const std::string& name_b);
bool matchesAny(const std::vector<PairRule>& rules, const std::string& name_a, const std::string& name_b);

/// Why a pair is left out by the rules: "allowed_pairs: hand* - table"; empty if it is not.
std::string whyAllowed(const PairRules& rules, const std::string& name_a, const std::string& name_b);

/// Adds a warning for each pattern of the rules that matches no body's name. @param list  the rules' parameter.
void warnOfUnknown(const char* list, const std::vector<PairRule>& rules, const SceneDescription& scene,
                   std::vector<std::string>& warnings);

/// Leaves out pairs of a scene that are allowed to touch, and includes pairs that are to be checked although they were
/// left out.
/// @param scene     with all of its bodies and allowed pairs.
/// @param warnings  gets a line for each pattern that matches no body's name.
void applyRules(const PairRules& rules, SceneDescription& scene, std::vector<std::string>& warnings);

}  // namespace sdf_ccd
