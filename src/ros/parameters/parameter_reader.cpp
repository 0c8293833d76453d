#include "ros/parameters/parameter_reader.h"

#include <cmath>
#include <locale>
#include <optional>
#include <sstream>

#include "common/number_text.h"
#include "common/read_number.h"
#include "common/shown_text.h"

namespace sdf_ccd {
namespace {

using XmlRpc::XmlRpcValue;

constexpr std::size_t kMaxName = 256;  // bytes

/// The value as YAML text.
std::string written(XmlRpcValue value) {
  const auto joined = [](auto& members, const auto& textOf) {
    std::string text;
    for (auto& member : members) text += (text.empty() ? "" : ", ") + textOf(member);
    return text;
  };
  std::vector<XmlRpcValue> items;
  std::ostringstream plain;
  plain.imbue(std::locale::classic());
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpcValue::TypeDouble:
      return numberText(static_cast<double>(value));
    case XmlRpcValue::TypeArray:
      for (int i = 0; i < value.size(); ++i) items.push_back(value[i]);
      return "[" + joined(items, [](XmlRpcValue& item) { return written(item); }) + "]";
    case XmlRpcValue::TypeStruct:
      return "{" + joined(value, [](auto& member) { return member.first + ": " + written(member.second); }) + "}";
    default:
      plain << value;
      return plain.str();
  }
}

/// Reads the value as a finite number. YAML takes 1.0e8 (without a sign in the exponent) for a text; here it is a
/// number as well.
/// @return false if it is not a number.
bool toNumber(const XmlRpcValue& value, double& number) {
  XmlRpcValue copy = value;
  if (value.getType() == XmlRpcValue::TypeInt) {
    number = static_cast<int>(copy);
  } else if (value.getType() == XmlRpcValue::TypeDouble) {
    number = static_cast<double>(copy);
  } else if (value.getType() == XmlRpcValue::TypeString) {
    const std::optional<double> read = wholeNumber(static_cast<std::string&>(copy));
    if (!read) return false;
    number = *read;
  } else {
    return false;
  }
  return std::isfinite(number);
}

SettingKeys::Names keysOf(XmlRpcValue tree) {
  SettingKeys::Names keys;
  if (tree.getType() != XmlRpcValue::TypeStruct) return keys;
  for (const auto& member : tree) keys.insert(member.first);
  return keys;
}

}  // namespace

ParameterReader::ParameterReader(const XmlRpcValue& tree, std::string name)
    : tree_(tree), name_(std::move(name)), keys_(keysOf(tree)) {}

bool ParameterReader::has(const std::string& key) {
  keys_.know(key);
  return keys_.isSet(key);
}

bool ParameterReader::isText(const std::string& key) {
  return has(key) && tree_[key].getType() == XmlRpcValue::TypeString;
}

bool ParameterReader::isGroup(const std::string& key) {
  return has(key) && tree_[key].getType() == XmlRpcValue::TypeStruct;
}

XmlRpcValue* ParameterReader::find(const std::string& key) {
  keys_.read(key);
  return has(key) ? &tree_[key] : nullptr;
}

void ParameterReader::fail(const std::string& key, const std::string& expected) const {
  const std::string state = keys_.isSet(key) ? " is " + shownText(written(tree_[key])) : " is missing";
  const std::string misspelt = keys_.misspellingOf(key);
  throw ParameterError("parameter " + name_ + "/" + key + state + ", expected " + expected +
                       (misspelt.empty() ? "" : "; is it " + misspelt + "?"));
}

double ParameterReader::number(const std::string& key, double fallback) {
  XmlRpcValue* value = find(key);
  if (!value) return fallback;
  double number = 0.0;
  if (!toNumber(*value, number)) fail(key, "a finite number");
  return number;
}

double ParameterReader::positive(const std::string& key, double fallback) {
  const double value = number(key, fallback);
  if (!(value > 0.0)) fail(key, "a positive number");
  return value;
}

double ParameterReader::notNegative(const std::string& key, double fallback) {
  const double value = number(key, fallback);
  if (!(value >= 0.0)) fail(key, "a non-negative number");
  return value;
}

int ParameterReader::integer(const std::string& key, int fallback, int smallest) {
  XmlRpcValue* value = find(key);
  if (!value) return fallback;
  if (value->getType() != XmlRpcValue::TypeInt || static_cast<int>(*value) < smallest) {
    fail(key, "an integer of at least " + std::to_string(smallest));
  }
  return *value;
}

bool ParameterReader::flag(const std::string& key, bool fallback) {
  XmlRpcValue* value = find(key);
  if (!value) return fallback;
  if (value->getType() != XmlRpcValue::TypeBoolean) fail(key, "true or false");
  return *value;
}

std::string ParameterReader::text(const std::string& key, const std::string& fallback) {
  XmlRpcValue* value = find(key);
  if (!value) return fallback;
  if (value->getType() != XmlRpcValue::TypeString) fail(key, "a string");
  return *value;
}

std::string ParameterReader::name(const std::string& key, const std::string& fallback) {
  std::string value = text(key, fallback);
  if (value.size() > kMaxName || value != shownText(value)) {
    fail(key, "at most " + std::to_string(kMaxName) + " bytes without control characters");
  }
  return value;
}

int ParameterReader::choice(const std::string& key, std::initializer_list<const char*> choices, int fallback) {
  const std::string value = text(key, "");
  if (!keys_.isSet(key)) return fallback;
  std::string expected = "one of";
  int index = 0;
  for (const char* choice : choices) {
    if (value == choice) return index;
    expected += std::string(" ") + choice;
    ++index;
  }
  fail(key, expected);
}

Vector3d ParameterReader::vector(const std::string& key, const Vector3d& fallback) {
  XmlRpcValue* value = find(key);
  if (!value) return fallback;
  if (value->getType() != XmlRpcValue::TypeArray || value->size() != 3) fail(key, "three numbers");
  Vector3d result;
  for (int i = 0; i < 3; ++i) {
    if (!toNumber((*value)[i], result[i])) fail(key, "three finite numbers");
  }
  return result;
}

std::vector<double> ParameterReader::numbers(const std::string& key, std::size_t min_count, std::size_t max_count) {
  XmlRpcValue* value = find(key);
  const std::string expected = "a list of " + std::to_string(min_count) +
                               (min_count == max_count ? "" : " to " + std::to_string(max_count)) + " finite numbers";
  if (!value || value->getType() != XmlRpcValue::TypeArray) fail(key, expected);
  const auto size = static_cast<std::size_t>(value->size());
  if (size < min_count || size > max_count) fail(key, expected);
  std::vector<double> numbers(size);
  for (std::size_t i = 0; i < size; ++i)
    if (!toNumber((*value)[static_cast<int>(i)], numbers[i])) fail(key, expected);
  return numbers;
}

std::vector<std::string> ParameterReader::texts(const std::string& key) {
  std::vector<std::string> texts;
  XmlRpcValue* value = find(key);
  if (!value) return texts;
  if (value->getType() != XmlRpcValue::TypeArray) fail(key, "a list of non-empty strings");
  for (int i = 0; i < value->size(); ++i) {
    XmlRpcValue& text = (*value)[i];
    if (text.getType() != XmlRpcValue::TypeString || static_cast<std::string>(text).empty())
      fail(key, "a list of non-empty strings");
    texts.push_back(static_cast<std::string>(text));
  }
  return texts;
}

std::vector<std::pair<std::string, std::string>> ParameterReader::textPairs(const std::string& key) {
  std::vector<std::pair<std::string, std::string>> pairs;
  XmlRpcValue* value = find(key);
  if (!value) return pairs;
  const char* const expected = "a list of pairs of strings, as [[hand, table], [\"finger_*\", \"finger_*\"]]";
  const auto isText = [](XmlRpcValue& text) {
    return text.getType() == XmlRpcValue::TypeString && !static_cast<std::string>(text).empty();
  };
  if (value->getType() != XmlRpcValue::TypeArray) fail(key, expected);
  for (int i = 0; i < value->size(); ++i) {
    XmlRpcValue& pair = (*value)[i];
    if (pair.getType() != XmlRpcValue::TypeArray || pair.size() != 2 || !isText(pair[0]) || !isText(pair[1]))
      fail(key, expected);
    pairs.emplace_back(static_cast<std::string>(pair[0]), static_cast<std::string>(pair[1]));
  }
  return pairs;
}

ParameterReader ParameterReader::group(const std::string& key) {
  XmlRpcValue* value = find(key);
  if (value && value->getType() != XmlRpcValue::TypeStruct) fail(key, "a group of parameters");
  return {value ? *value : XmlRpcValue(), name_ + "/" + key};
}

std::vector<ParameterReader> ParameterReader::list(const std::string& key) {
  std::vector<ParameterReader> readers;
  XmlRpcValue* value = find(key);
  if (!value) return readers;
  if (value->getType() != XmlRpcValue::TypeArray) fail(key, "a list");
  for (int i = 0; i < value->size(); ++i) {
    const std::string name = key + "[" + std::to_string(i) + "]";
    if ((*value)[i].getType() != XmlRpcValue::TypeStruct) fail(key, "a list of groups of parameters");
    readers.emplace_back((*value)[i], name_ + "/" + name);
  }
  return readers;
}

std::vector<std::string> ParameterReader::unread() const {
  std::vector<std::string> texts;
  for (const std::string& name : keys_.unread()) texts.push_back(name_ + "/" + name + keys_.suggestionFor(name));
  return texts;
}

void ParameterReader::finish() const {
  const std::vector<std::string> names = unread();
  if (!names.empty()) throw ParameterError("unknown parameter " + names.front());
}

}  // namespace sdf_ccd
