#pragma once

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/settings/setting.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Reads a group of settings with their types, and reports the settings that were not read, so that a misspelt one is
/// not taken for one that is not set. A value without a fallback must be set. What cannot be used is a
/// std::runtime_error with its line (of a file), name and value.
class SettingsReader {
 public:
  /// @param group  a group, or anything else if there are no settings
  /// @param name   of the group, for errors: "/collision_monitor"; empty for a file, whose name the caller adds
  SettingsReader(Setting group, std::string name);

  const std::string& name() const { return name_; }
  std::vector<std::string> keys() const;

  /// Whether the setting is set; it does not count as read. If it is not set, it may be suggested for a misspelt one.
  bool has(const std::string& key);
  bool isText(const std::string& key) { return has(key) && members().at(key).isText(); }
  bool isGroup(const std::string& key) { return has(key) && members().at(key).isGroup(); }

  /// Finite.
  double number(const std::string& key, std::optional<double> fallback = {});
  double positive(const std::string& key, std::optional<double> fallback = {});
  double notNegative(const std::string& key, std::optional<double> fallback = {});
  int integer(const std::string& key, std::optional<int> fallback, int smallest,
              int largest = std::numeric_limits<int>::max());
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::optional<std::string>& fallback = {});

  /// The name of a frame or a body, which is part of messages and tables: at most 256 bytes, on one line. It may be
  /// empty only as the fallback.
  std::string name(const std::string& key, const std::optional<std::string>& fallback = {});

  /// Index of the value among `choices`, which an enum numbers.
  int choice(const std::string& key, const std::vector<std::string>& choices, std::optional<int> fallback = {});
  template <class Enum, class = std::enable_if_t<std::is_enum_v<Enum>>>
  Enum choice(const std::string& key, const std::vector<std::string>& choices, Enum fallback) {
    return static_cast<Enum>(choice(key, choices, static_cast<int>(fallback)));
  }

  Vector3d vector(const std::string& key, const std::optional<Vector3d>& fallback = {});

  /// A list of `count` finite numbers.
  std::vector<double> numbers(const std::string& key, std::size_t count);

  /// A list of strings, none of them empty; no strings if it is not set.
  std::vector<std::string> texts(const std::string& key);

  /// A list of pairs of strings; no pairs if it is not set.
  std::vector<std::pair<std::string, std::string>> textPairs(const std::string& key);

  /// An empty group, or no groups, if it is not set.
  SettingsReader group(const std::string& key);
  std::vector<SettingsReader> list(const std::string& key);

  /// The settings of this group (not of its subgroups) that were not read, each with a suggestion: "~/filed, did you
  /// mean field?".
  std::vector<std::string> unread() const;

  /// Throws if there is one.
  void finish() const;

  [[noreturn]] void fail(const std::string& key, const std::string& expected) const;

 private:
  Setting group_;
  std::string name_;
  std::set<std::string> known_, read_;  // read_ is a part of known_

  const Setting::Group& members() const { return std::get<Setting::Group>(group_.value); }
  std::string pathOf(const std::string& key) const { return name_.empty() ? key : name_ + "/" + key; }
  std::set<std::string> unreadKeys() const;

  /// @param convert  gives the value, or none if it is not what is expected.
  template <class T, class Convert>
  T read(const std::string& key, const std::optional<T>& fallback, const std::string& expected, const Convert& convert);
};

}  // namespace sdf_ccd
