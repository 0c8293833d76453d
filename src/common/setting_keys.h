#pragma once

#include <set>
#include <string>
#include <utility>

namespace sdf_ccd {

/// Which keys of a map of settings (of a file, of parameters) have been read, so that a misspelt key is not taken for
/// one that is not set.
class SettingKeys {
 public:
  using Names = std::set<std::string>;

  /// @param set  the keys that the map contains.
  explicit SettingKeys(Names set) : set_(std::move(set)) {}

  bool isSet(const std::string& key) const { return set_.count(key) > 0; }
  bool isRead(const std::string& key) const { return read_.count(key) > 0; }

  /// A key that exists, without being read: it may be suggested for a misspelt one.
  void know(const std::string& key) { known_.insert(key); }
  void read(const std::string& key) {
    know(key);
    read_.insert(key);
  }

  /// The keys that are set but were not read.
  Names unread() const;

  /// For errors about a key that does not exist: a known key that is not set, as by suggestion().
  std::string suggestionFor(const std::string& key) const;

  /// For errors about a key that is missing: the unread key that may have been meant for it; empty if there is none.
  std::string misspellingOf(const std::string& key) const;

 private:
  Names set_, known_, read_;  // read_ is a part of known_
};

}  // namespace sdf_ccd
