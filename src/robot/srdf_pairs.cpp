#include "srdf_pairs.h"

#include <algorithm>

namespace sdf_ccd {
SrdfPairs::SrdfPairs(const Srdf& srdf) {
  for (const PairDecision& pair : srdf.disabled) {
    if (isPattern(pair.body_a) || isPattern(pair.body_b)) {
      disabled_patterns_.push_back({{pair.body_a, pair.body_b}, pair.text});
    } else {
      disabled_.emplace(namePair(pair.body_a, pair.body_b), pair.text);
    }
  }
  for (const auto& [a, b] : srdf.enabled) {
    if (isPattern(a) || isPattern(b)) {
      enabled_patterns_.push_back({a, b});
    } else {
      enabled_.insert(namePair(a, b));
    }
  }
  for (const std::string& link : srdf.disabled_by_default) {
    if (isPattern(link)) {
      default_patterns_.push_back(link);
    } else {
      by_default_.insert(link);
    }
  }
}

std::string SrdfPairs::whyDisabled(const std::string& link_a, const std::string& link_b) const {
  const auto found = disabled_.find(namePair(link_a, link_b));
  if (found != disabled_.end()) return found->second;
  for (const auto& [rule, reason] : disabled_patterns_)
    if (matches(rule, link_a, link_b)) return reason;
  return {};
}

bool SrdfPairs::isEnabled(const std::string& link_a, const std::string& link_b) const {
  return enabled_.count(namePair(link_a, link_b)) > 0 || matchesAny(enabled_patterns_, link_a, link_b);
}

bool SrdfPairs::isDisabledByDefault(const std::string& link) const {
  return by_default_.count(link) > 0 || std::any_of(default_patterns_.begin(), default_patterns_.end(),
                                                    [&](const std::string& pattern) { return matches(pattern, link); });
}

const char* srdfReason(PairKind kind) {
  switch (kind) {
    case PairKind::kAdjacent:
      return "Adjacent";
    case PairKind::kNever:
      return "Never";
    case PairKind::kAlways:
    case PairKind::kHeld:
      return "Always";
    default:
      return "Default";
  }
}

std::vector<std::string> unknownLinks(const Srdf& srdf, const std::vector<std::string>& links) {
  std::set<std::string> named(srdf.disabled_by_default.begin(), srdf.disabled_by_default.end());
  for (const PairDecision& pair : srdf.disabled) named.insert({pair.body_a, pair.body_b});
  for (const auto& [a, b] : srdf.enabled) named.insert({a, b});
  for (const auto& [joint, child] : srdf.virtual_joints) named.insert(child);
  for (const std::string& link : links) named.erase(link);
  std::vector<std::string> unknown;
  for (const std::string& name : named) {
    const bool matched = isPattern(name) && std::any_of(links.begin(), links.end(),
                                                        [&](const std::string& link) { return matches(name, link); });
    if (!matched) unknown.push_back(name);
  }
  return unknown;
}

}  // namespace sdf_ccd
