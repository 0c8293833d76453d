#include "pair_rules.h"

#include <algorithm>
#include <set>

#include "common/nearest_name.h"
#include "name_pair.h"

namespace sdf_ccd {

void warnOfUnknown(const char* list, const std::vector<PairRule>& rules, const SceneDescription& scene,
                   std::vector<std::string>& warnings) {
  std::set<std::string> names, reported;
  for (const BodyDescription& body : scene.bodies) names.insert(body.name);
  for (const PairRule& rule : rules)
    for (const std::string& pattern : {rule.a, rule.b}) {
      const bool known =
          std::any_of(names.begin(), names.end(), [&](const std::string& name) { return matches(pattern, name); });
      if (known || !reported.insert(pattern).second) continue;
      warnings.push_back(std::string(list) + ": no body is named " + pattern + suggestion(pattern, names));
    }
}

bool isPattern(const std::string& text) {
  return text.find_first_of("*?") != std::string::npos;
}

bool matches(const std::string& pattern, const std::string& name) {
  std::size_t p = 0, n = 0;
  std::size_t star = std::string::npos, held = 0;  // the last star, and the end of the text it matches
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      held = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string::npos) {
      p = star + 1;
      n = ++held;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

bool matches(const PairRule& rule, const std::string& name_a, const std::string& name_b) {
  return (matches(rule.a, name_a) && matches(rule.b, name_b)) || (matches(rule.a, name_b) && matches(rule.b, name_a));
}

bool matchesAny(const std::vector<PairRule>& rules, const std::string& name_a, const std::string& name_b) {
  return std::any_of(rules.begin(), rules.end(), [&](const PairRule& rule) { return matches(rule, name_a, name_b); });
}

std::string whyAllowed(const PairRules& rules, const std::string& name_a, const std::string& name_b) {
  const auto rule = std::find_if(rules.allowed.begin(), rules.allowed.end(),
                                 [&](const PairRule& allowed) { return matches(allowed, name_a, name_b); });
  if (rule == rules.allowed.end() || matchesAny(rules.checked, name_a, name_b)) return "";
  return "allowed_pairs: " + pairName(rule->a, rule->b);
}

void applyRules(const PairRules& rules, SceneDescription& scene, std::vector<std::string>& warnings) {
  warnOfUnknown("allowed_pairs", rules.allowed, scene, warnings);
  warnOfUnknown("checked_pairs", rules.checked, scene, warnings);
  if (rules.allowed.empty() && rules.checked.empty()) return;
  auto& allowed = scene.allowed;
  const auto wanted = [&](const PairDecision& pair) { return matchesAny(rules.checked, pair.body_a, pair.body_b); };
  allowed.erase(std::remove_if(allowed.begin(), allowed.end(), wanted), allowed.end());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (std::size_t k = i + 1; k < scene.bodies.size(); ++k) {
      const std::string &a = scene.bodies[i].name, &b = scene.bodies[k].name;
      const std::string reason = whyAllowed(rules, a, b);
      if (!reason.empty()) allowed.push_back({a, b, reason});
    }
}

}  // namespace sdf_ccd
