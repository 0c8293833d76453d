#include "robot_monitor/request_permissions.h"

#include <algorithm>
#include <array>

#include "common/refuse.h"
#include "common/shown_text.h"
#include "scene/pair_rules.h"

namespace sdf_ccd {
namespace {

using NamedKind = std::pair<const char*, bool RequestPermissions::*>;

constexpr std::array<NamedKind, 7> kKinds{
    NamedKind{"add", &RequestPermissions::add},       NamedKind{"move", &RequestPermissions::move},
    NamedKind{"attach", &RequestPermissions::attach}, NamedKind{"rules", &RequestPermissions::rules},
    NamedKind{"clear", &RequestPermissions::clear},   NamedKind{"reset", &RequestPermissions::reset},
    NamedKind{"limits", &RequestPermissions::limits}};

}  // namespace

void requireName(const std::string& name, const std::string& what, const RequestLimits& limits) {
  if (name.empty()) refuse(what + " is missing");
  if (name.size() > limits.name) refuse(what + " has more than " + std::to_string(limits.name) + " characters");
  if (name != shownText(name)) refuse(what + " " + shownText(name) + " contains control characters");
}

bool RequestPermissions::isProtected(const std::string& body) const {
  return std::any_of(protected_bodies.begin(), protected_bodies.end(),
                     [&](const std::string& pattern) { return matches(pattern, body); });
}

void RequestPermissions::requireUnprotected(const std::string& body, const std::string& what) const {
  if (isProtected(body)) refuse(what + ": " + shownText(body) + " is protected (parameter requests/protected)");
}

void requireAllowed(bool is_allowed, const std::string& kind, const std::string& what) {
  if (!is_allowed) refuse(what + ": requests may not do that (parameter requests/allow does not hold " + kind + ")");
}

RequestPermissions permissionsOf(const std::vector<std::string>& kinds) {
  RequestPermissions permissions;
  for (const auto& [name, kind] : kKinds) permissions.*kind = false;
  for (const std::string& wanted : kinds) {
    const auto known =
        std::find_if(kKinds.begin(), kKinds.end(), [&](const NamedKind& kind) { return kind.first == wanted; });
    if (known == kKinds.end()) refuse(wanted);
    permissions.*(known->second) = true;
  }
  return permissions;
}

}  // namespace sdf_ccd
