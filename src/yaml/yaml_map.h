#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "common/number_text.h"
#include "common/read_number.h"
#include "common/setting_keys.h"
#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A YAML map that is read key by key. A key that was not read, or that appears twice, is an error, so that nothing is
/// ignored by mistake.
class YamlMap {
 public:
  YamlMap(const YAML::Node& node, std::string what) : node_(node), what_(std::move(what)), keys_(keysOf(node)) {}

  bool has(const std::string& key) const { return keys_.isSet(key); }

  /// A required node.
  YAML::Node node(const std::string& key) {
    keys_.read(key);
    if (!has(key)) fail(node_, "`" + key + "` is missing");
    return node_[key];
  }

  template <class T>
  T get(const std::string& key) {
    return convert<T>(node(key), key);
  }
  template <class T>
  T get(const std::string& key, const T& otherwise) {
    keys_.read(key);
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
    keys_.read(key);
    return has(key) ? vector(key) : otherwise;
  }

  /// Throws if the map has a key that was not read.
  void finish() const {
    for (const auto& entry : node_) {
      const auto key = entry.first.Scalar();
      if (!keys_.isRead(key)) fail(entry.first, "`" + key + "` is not a known key" + keys_.suggestionFor(key));
    }
  }

  [[noreturn]] void fail(const YAML::Node& at, const std::string& reason) const {
    throw std::runtime_error("line " + std::to_string(at.Mark().line + 1) + ", " + what_ + ": " + reason);
  }

 private:
  SettingKeys::Names keysOf(const YAML::Node& node) const {
    if (!node.IsMap()) fail(node, "a map is expected");
    SettingKeys::Names keys;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) fail(entry.first, "a key must be a word");
      if (!keys.insert(entry.first.Scalar()).second) fail(entry.first, "`" + entry.first.Scalar() + "` occurs twice");
    }
    return keys;
  }

  /// Infinity is .inf in YAML.
  static std::optional<double> numberOf(std::string text) {
    const std::size_t dot = text.find('.');
    if (dot != std::string::npos && (text[dot + 1] == 'i' || text[dot + 1] == 'n')) text.erase(dot, 1);
    return wholeNumber(text);
  }
  template <class T>
  static bool isInteger(double number) {
    return number == std::floor(number) && std::abs(number) <= double(std::numeric_limits<T>::max());
  }

  template <class T>
  T convert(const YAML::Node& value, const std::string& key) const {
    try {
      if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
        // Not by the parser, whose streams follow the program's locale.
        const std::optional<double> number = value.IsScalar() ? numberOf(value.Scalar()) : std::nullopt;
        if (!number || (std::is_integral_v<T> && !isInteger<T>(*number))) throw YAML::BadConversion(value.Mark());
        return static_cast<T>(*number);
      } else {
        return value.as<T>();
      }
    } catch (const YAML::Exception&) {
      const std::string given = value.IsScalar() ? "\"" + value.Scalar() + "\"" : "a list or map";
      fail(value, "`" + key + "`: " + given + " is not a valid value");
    }
  }

  YAML::Node node_;
  std::string what_;
  SettingKeys keys_;
};

}  // namespace sdf_ccd
