#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <XmlRpcValue.h>

#include "common/setting_keys.h"
#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A parameter that cannot be used; the message gives its name and value.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a tree of parameters with their types, and reports the parameters that were not read.
class ParameterReader {
 public:
  /// @param tree  a struct, or anything else if there are no parameters
  /// @param name  of the tree, for errors: "/collision_monitor"
  ParameterReader(const XmlRpc::XmlRpcValue& tree, std::string name);

  const std::string& name() const { return name_; }

  /// Whether the parameter is set; it does not count as read. If it is not set, it may be suggested for a misspelt one.
  bool has(const std::string& key);
  bool isText(const std::string& key);
  bool isGroup(const std::string& key);

  double number(const std::string& key, double fallback);
  double positive(const std::string& key, double fallback);     ///< > 0 and finite
  double notNegative(const std::string& key, double fallback);  ///< ≥ 0 and finite
  int integer(const std::string& key, int fallback, int smallest);
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);

  /// The name of a frame or a body, which is part of messages and tables: at most 256 bytes, on one line.
  std::string name(const std::string& key, const std::string& fallback);

  /// Index of the value among `choices`.
  int choice(const std::string& key, std::initializer_list<const char*> choices, int fallback);

  Vector3d vector(const std::string& key, const Vector3d& fallback);

  /// A list of `min_count` to `max_count` finite numbers; fails if it is not set.
  std::vector<double> numbers(const std::string& key, std::size_t min_count, std::size_t max_count);

  /// A list of strings, none of them empty; no strings if it is not set.
  std::vector<std::string> texts(const std::string& key);

  /// A list of pairs of strings; no pairs if it is not set.
  std::vector<std::pair<std::string, std::string>> textPairs(const std::string& key);

  ParameterReader group(const std::string& key);
  std::vector<ParameterReader> list(const std::string& key);

  /// The parameters of this group (not of its subgroups) that were not read, each with a suggestion: "~/filed, did you
  /// mean field?".
  std::vector<std::string> unread() const;

  /// Throws if there is one, so that a misspelt parameter is not taken for one that is not set.
  void finish() const;

  [[noreturn]] void fail(const std::string& key, const std::string& expected) const;

 private:
  XmlRpc::XmlRpcValue tree_;
  std::string name_;
  SettingKeys keys_;

  /// Null if it is not set.
  XmlRpc::XmlRpcValue* find(const std::string& key);
};

}  // namespace sdf_ccd
