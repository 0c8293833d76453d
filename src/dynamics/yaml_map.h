#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "common/nearest_name.h"
#include "common/number_text.h"
#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A YAML map that is read key by key. A key that was not read, or that appears twice, is an error, so that nothing is
/// ignored by mistake.
class YamlMap {
 public:
  YamlMap(const YAML::Node& node, std::string what) : node_(node), what_(std::move(what)) {
    if (!node_.IsMap()) fail(node_, "a map is expected");
    std::set<std::string> keys;
    for (const auto& entry : node_) {
      if (!entry.first.IsScalar()) fail(entry.first, "a key must be a word");
      if (!keys.insert(entry.first.Scalar()).second) fail(entry.first, "`" + entry.first.Scalar() + "` occurs twice");
    }
  }

  bool has(const std::string& key) const { return bool(node_[key]); }

  /// A required node.
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

  /// Index of the value in `words`.
  std::size_t choice(const std::string& key, const std::vector<std::string>& words, const std::string& otherwise) {
    const auto chosen = get(key, otherwise);
    const auto found = std::find(words.begin(), words.end(), chosen);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    std::string wanted;
    for (const std::string& word : words) wanted += (wanted.empty() ? "" : " or ") + word;
    fail(node(key), "`" + key + "`: expected " + wanted + ", got " + chosen);
  }

  /// An integer from `low` to `high`.
  int count(const std::string& key, int otherwise, int low, int high) {
    const int value = get(key, otherwise);
    if (value >= low && value <= high) return value;
    fail(node(key), "`" + key + "` must be " + std::to_string(low) + " to " + std::to_string(high) + ", got " +
                        std::to_string(value));
  }

  /// A length, finite and above 0.
  double positive(const std::string& key, double otherwise) {
    const double value = get(key, otherwise);
    if (value > 0.0 && std::isfinite(value)) return value;
    fail(has(key) ? node(key) : node_, "`" + key + "` must be finite and positive, got " + numberText(value));
  }

  /// Three numbers.
  Vector3d vector(const std::string& key) {
    const YAML::Node list = node(key);
    if (!list.IsSequence() || list.size() != 3) fail(list, "`" + key + "`: expected three numbers");
    return {convert<double>(list[0], key), convert<double>(list[1], key), convert<double>(list[2], key)};
  }
  Vector3d vector(const std::string& key, const Vector3d& otherwise) {
    read_.insert(key);
    return has(key) ? vector(key) : otherwise;
  }

  /// Throws if the map has a key that was not read.
  void finish() const {
    for (const auto& entry : node_) {
      const auto key = entry.first.Scalar();
      if (read_.count(key) == 0) fail(entry.first, "`" + key + "` is not a known key" + suggestion(key, unused()));
    }
  }

  [[noreturn]] void fail(const YAML::Node& at, const std::string& reason) const {
    throw std::runtime_error("line " + std::to_string(at.Mark().line + 1) + ", " + what_ + ": " + reason);
  }

 private:
  /// Optional keys that are missing.
  std::set<std::string> unused() const {
    std::set<std::string> keys;
    for (const std::string& key : read_)
      if (!has(key)) keys.insert(key);
    return keys;
  }

  template <class T>
  T convert(const YAML::Node& value, const std::string& key) const {
    try {
      return value.as<T>();
    } catch (const YAML::Exception&) {
      const std::string given = value.IsScalar() ? "\"" + value.Scalar() + "\"" : "a list or map";
      fail(value, "`" + key + "`: " + given + " is not a valid value");
    }
  }

  YAML::Node node_;
  std::string what_;
  std::set<std::string> read_;
};

}  // namespace sdf_ccd
