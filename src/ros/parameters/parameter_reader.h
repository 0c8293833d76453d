#pragma once

#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <XmlRpcValue.h>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A parameter that cannot be used; says its name and value.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a tree of parameters with their types, and knows afterwards which ones nobody asked for.
class ParameterReader {
 public:
  /// @param tree  a struct, or anything else if there are no parameters
  /// @param name  of the tree, for errors: "/collision_monitor"
  ParameterReader(const XmlRpc::XmlRpcValue& tree, std::string name);

  const std::string& name() const { return name_; }

  /// Whether it is set. One that is, is not read by this; one that is not may be what another was meant to be.
  bool has(const std::string& key);
  bool isText(const std::string& key);
  bool isGroup(const std::string& key);

  double number(const std::string& key, double fallback);
  double positive(const std::string& key, double fallback);     ///< > 0 and finite
  double notNegative(const std::string& key, double fallback);  ///< ≥ 0 and finite
  int integer(const std::string& key, int fallback, int smallest);
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);

  /// A text that names a frame or a body, and stands in every message and table: at most 256 bytes, on one line.
  std::string name(const std::string& key, const std::string& fallback);

  /// Index of the value among `choices`.
  int choice(const std::string& key, std::initializer_list<const char*> choices, int fallback);

  Vector3d vector(const std::string& key, const Vector3d& fallback);

  /// Finite ones, from `least` to `most` of them; fails if it is not set.
  std::vector<double> numbers(const std::string& key, std::size_t least, std::size_t most);

  /// Of a list of texts, none of them empty; none if it is not set.
  std::vector<std::string> texts(const std::string& key);

  /// Of lists of two texts each; none if it is not set.
  std::vector<std::pair<std::string, std::string>> textPairs(const std::string& key);

  ParameterReader group(const std::string& key);
  std::vector<ParameterReader> list(const std::string& key);

  /// What was not read, of this group only, each with what may have been meant: "~/filed, did you mean field?".
  std::vector<std::string> unread() const;

  /// Throws if there is such, so that a misspelt parameter is not taken for one that is not set.
  void finish() const;

  [[noreturn]] void fail(const std::string& key, const std::string& expected) const;

 private:
  XmlRpc::XmlRpcValue tree_;
  std::string name_;
  std::set<std::string> read_, known_;  // the latter also if only looked for

  /// Null if it is not set.
  XmlRpc::XmlRpcValue* find(const std::string& key);

  bool isSet(const std::string& key) const;
  std::set<std::string> unset() const;  ///< of what is known
  std::set<std::string> notRead() const;
};

}  // namespace sdf_ccd
