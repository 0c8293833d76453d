#pragma once

#include <set>
#include <stdexcept>
#include <string>

#include <yaml-cpp/yaml.h>

#include "sdf_ccd/geometry/eigen_types.h"

namespace sdf_ccd {

/// A YAML map that is read key by key; what nobody read is an error, so that a mistyped key is not lost.
class YamlMap {
 public:
  YamlMap(const YAML::Node& node, std::string what) : node_(node), what_(std::move(what)) {
    if (!node_.IsMap()) fail(node_, "a map is wanted");
  }

  bool has(const std::string& key) const { return bool(node_[key]); }

  /// A node that must be there.
  YAML::Node node(const std::string& key) {
    read_.insert(key);
    if (!node_[key]) fail(node_, "`" + key + "` is missing");
    return node_[key];
  }

  template <class T>
  T get(const std::string& key) {
    return convert<T>(node(key), key);
  }
  template <class T>
  T get(const std::string& key, const T& otherwise) {
    read_.insert(key);
    return has(key) ? get<T>(key) : otherwise;
  }

  /// Three numbers.
  Vector3d vector(const std::string& key) {
    const YAML::Node list = node(key);
    if (!list.IsSequence() || list.size() != 3) fail(list, "`" + key + "`: three numbers are wanted");
    return {convert<double>(list[0], key), convert<double>(list[1], key), convert<double>(list[2], key)};
  }
  Vector3d vector(const std::string& key, const Vector3d& otherwise) {
    read_.insert(key);
    return has(key) ? vector(key) : otherwise;
  }

  /// Throws if a key was not read.
  void finish() const {
    for (const auto& entry : node_) {
      const auto key = entry.first.as<std::string>();
      if (read_.count(key) == 0) fail(entry.first, "`" + key + "` is not known here");
    }
  }

  [[noreturn]] void fail(const YAML::Node& at, const std::string& reason) const {
    throw std::runtime_error("line " + std::to_string(at.Mark().line + 1) + ", " + what_ + ": " + reason);
  }

 private:
  template <class T>
  T convert(const YAML::Node& value, const std::string& key) const {
    try {
      return value.as<T>();
    } catch (const YAML::Exception&) {
      fail(value, "`" + key + "` cannot be " + (value.IsScalar() ? "\"" + value.Scalar() + "\"" : "a list or map"));
    }
  }

  YAML::Node node_;
  std::string what_;
  std::set<std::string> read_;
};

}  // namespace sdf_ccd
