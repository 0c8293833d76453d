#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/pair_rules.h"
#include "ros/parameters/request_permissions.h"

namespace sdf_ccd {

/// A rule about pairs of bodies that a request has made.
struct RequestRule {
  PairRule pair;
  bool is_allowed;  ///< they may touch; else they are checked
};

/// Finds the last of many rules about each of many pairs: the patterns are matched once per body and not per pair, as
/// every map needs this for all of its tiles.
class RuleIndex {
 public:
  /// @param rules, permissions  must outlive this. No rule allows a pair with a protected body.
  RuleIndex(const std::vector<RequestRule>& rules, const RequestPermissions& permissions)
      : rules_(rules), permissions_(permissions) {}

  /// Null if there is none.
  const RequestRule* last(const std::string& body_a, const std::string& body_b);

  /// The last rule, if it allows the pair to touch; else null.
  const RequestRule* allowing(const std::string& body_a, const std::string& body_b);

 private:
  /// Which rules match a body as a, and as b: bit r is rule r.
  struct Matches {
    std::vector<std::uint64_t> a, b;
  };
  const Matches& of(const std::string& body);

  const std::vector<RequestRule>& rules_;
  const RequestPermissions& permissions_;
  std::unordered_map<std::string, Matches> known_;  // by body
};

}  // namespace sdf_ccd
