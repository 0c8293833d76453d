#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/name_pair.h"
#include "scene/pair_rules.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// The rules of an SRDF for pairs of links, by names and patterns.
class SrdfPairs {
 public:
  explicit SrdfPairs(const Srdf& srdf);

  /// Why the pair is disabled by name; empty if it is not.
  std::string whyDisabled(const std::string& link_a, const std::string& link_b) const;
  bool isEnabled(const std::string& link_a, const std::string& link_b) const;
  bool isDisabledByDefault(const std::string& link) const;

 private:
  std::map<NamePair, std::string> disabled_;
  std::set<NamePair> enabled_;
  std::set<std::string> by_default_;
  std::vector<std::pair<PairRule, std::string>> disabled_patterns_;
  std::vector<PairRule> enabled_patterns_;
  std::vector<std::string> default_patterns_;
};

/// The reason of such a pair in an SRDF, as MoveIt's setup assistant has it.
/// @param kind  kAdjacent, or learned from states.
const char* srdfReason(PairKind kind);

/// Names and patterns of an SRDF that no link has, in ascending order.
std::vector<std::string> unknownLinks(const Srdf& srdf, const std::vector<std::string>& links);

}  // namespace sdf_ccd
