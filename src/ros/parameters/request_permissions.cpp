#include "ros/parameters/request_permissions.h"

#include <algorithm>
#include <array>

#include "common/refuse.h"
#include "common/shown_text.h"
#include "scene/pair_rules.h"

namespace sdf_ccd {
namespace {

using Kind = std::pair<const char*, bool RequestPermissions::*>;

constexpr std::array<Kind, 7> kKinds{
    Kind{"add", &RequestPermissions::add},       Kind{"move", &RequestPermissions::move},
    Kind{"attach", &RequestPermissions::attach}, Kind{"rules", &RequestPermissions::rules},
    Kind{"clear", &RequestPermissions::clear},   Kind{"reset", &RequestPermissions::reset},
    Kind{"limits", &RequestPermissions::limits}};

}  // namespace

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
        std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& kind) { return kind.first == wanted; });
    if (known == kKinds.end()) refuse(wanted);
    permissions.*(known->second) = true;
  }
  return permissions;
}

}  // namespace sdf_ccd
