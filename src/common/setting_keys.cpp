#include "common/setting_keys.h"

#include <algorithm>
#include <iterator>

#include "common/nearest_name.h"

namespace sdf_ccd {
namespace {

SettingKeys::Names without(const SettingKeys::Names& names, const SettingKeys::Names& others) {
  SettingKeys::Names rest;
  std::set_difference(names.begin(), names.end(), others.begin(), others.end(), std::inserter(rest, rest.end()));
  return rest;
}

}  // namespace

SettingKeys::Names SettingKeys::unread() const {
  return without(set_, read_);
}

std::string SettingKeys::suggestionFor(const std::string& key) const {
  return suggestion(key, without(known_, set_));
}

std::string SettingKeys::misspellingOf(const std::string& key) const {
  return isSet(key) ? "" : nearestName(key, unread());
}

}  // namespace sdf_ccd
