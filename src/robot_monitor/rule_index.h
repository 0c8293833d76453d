#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "robot_monitor/request_permissions.h"
#include "scene/pair_rules.h"

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
  /// Which rules match a body as a, and as b: bit r is rule r.
  struct Matches {
    std::vector<std::uint64_t> a, b;
  };
  using Known = std::unordered_map<std::string, Matches>;  ///< by body

  /// @param rules, permissions  must outlive this. No rule allows a pair with a protected body.
  /// @param known  what an index of the same rules has found; may be null.
  RuleIndex(const std::vector<RequestRule>& rules, const RequestPermissions& permissions,
            std::shared_ptr<const Known> known = nullptr)
      : rules_(rules), permissions_(permissions), known_(std::move(known)) {}

  /// Null if there is none.
  const RequestRule* last(const std::string& body_a, const std::string& body_b);

  /// What it has found besides what it was given.
  Known found() && { return std::move(found_); }

 private:
  const Matches& of(const std::string& body);

  const std::vector<RequestRule>& rules_;
  const RequestPermissions& permissions_;
  std::shared_ptr<const Known> known_;
  Known found_;
};

}  // namespace sdf_ccd
