#include "common/settings/settings_reader.h"

#include <algorithm>
#include <cmath>

#include "common/nearest_name.h"
#include "common/number_text.h"
#include "common/read_number.h"
#include "common/shown_text.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxName = 256;  // bytes

template <class Items, class TextOf>
std::string joined(const Items& items, const TextOf& textOf) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + textOf(item);
  return text;
}

/// The value as YAML text.
std::string written(const Setting& setting) {
  struct Writer {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(int number) const { return std::to_string(number); }
    std::string operator()(double number) const { return numberText(number); }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const Setting::List& list) const { return "[" + joined(list, written) + "]"; }
    std::string operator()(const Setting::Group& group) const {
      return "{" + joined(group, [](const auto& member) { return member.first + ": " + written(member.second); }) + "}";
    }
  };
  return std::visit(Writer(), setting.value);
}

std::string lineText(int line) {
  return line > 0 ? "line " + std::to_string(line) + ": " : "";
}

template <class T>
std::optional<T> as(const Setting& setting) {
  const T* value = std::get_if<T>(&setting.value);
  return value ? std::make_optional(*value) : std::nullopt;
}

/// A finite number. YAML takes 1.0e8 (without a sign in the exponent) for a text; here it is a number as well.
std::optional<double> toNumber(const Setting& setting) {
  std::optional<double> number = as<double>(setting);
  if (const auto integer = as<int>(setting)) number = *integer;
  if (const auto text = as<std::string>(setting)) number = wholeNumber(*text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::string> nonEmptyText(const Setting& setting) {
  const auto text = as<std::string>(setting);
  return text && !text->empty() ? text : std::nullopt;
}

std::optional<Setting> asGroup(const Setting& setting) {
  return setting.isGroup() ? std::make_optional(setting) : std::nullopt;
}

/// The items of a list, each converted; none if it is not a list, or one of them cannot be.
template <class T, class Convert>
std::optional<std::vector<T>> toList(const Setting& setting, const Convert& convert) {
  const auto* list = std::get_if<Setting::List>(&setting.value);
  if (!list) return std::nullopt;
  std::vector<T> items;
  for (const Setting& item : *list) {
    const std::optional<T> converted = convert(item);
    if (!converted) return std::nullopt;
    items.push_back(*converted);
  }
  return items;
}

template <class T, class Convert>
std::optional<std::vector<T>> toList(const Setting& setting, std::size_t count, const Convert& convert) {
  const auto list = toList<T>(setting, convert);
  return list && list->size() == count ? list : std::nullopt;
}

}  // namespace

SettingsReader::SettingsReader(Setting group, std::string name) : group_(std::move(group)), name_(std::move(name)) {
  if (!group_.isGroup()) group_.value = Setting::Group();
}

std::vector<std::string> SettingsReader::keys() const {
  std::vector<std::string> keys;
  for (const auto& member : members()) keys.push_back(member.first);
  return keys;
}

bool SettingsReader::has(const std::string& key) {
  known_.insert(key);
  return members().count(key) > 0;
}

void SettingsReader::fail(const std::string& key, const std::string& expected) const {
  const auto found = members().find(key);
  const bool is_set = found != members().end();
  const std::string state = is_set ? " is " + shownText(written(found->second)) : " is missing";
  const std::string misspelt = is_set ? "" : nearestName(key, unreadKeys());
  throw std::runtime_error(lineText(is_set ? found->second.line : group_.line) + "parameter " + pathOf(key) + state +
                           ", expected " + expected + (misspelt.empty() ? "" : "; is it " + misspelt + "?"));
}

template <class T, class Convert>
T SettingsReader::read(const std::string& key, const std::optional<T>& fallback, const std::string& expected,
                       const Convert& convert) {
  read_.insert(key);
  const std::optional<T> value = has(key) ? convert(members().at(key)) : fallback;
  if (!value) fail(key, expected);
  return *value;
}

double SettingsReader::number(const std::string& key, std::optional<double> fallback) {
  return read(key, fallback, "a finite number", toNumber);
}

double SettingsReader::positive(const std::string& key, std::optional<double> fallback) {
  return read(key, fallback, "a positive number", [](const Setting& setting) {
    const auto number = toNumber(setting);
    return number && *number > 0.0 ? number : std::nullopt;
  });
}

double SettingsReader::notNegative(const std::string& key, std::optional<double> fallback) {
  return read(key, fallback, "a non-negative number", [](const Setting& setting) {
    const auto number = toNumber(setting);
    return number && *number >= 0.0 ? number : std::nullopt;
  });
}

int SettingsReader::integer(const std::string& key, std::optional<int> fallback, int smallest, int largest) {
  const bool is_limited = largest < std::numeric_limits<int>::max();
  const std::string expected = is_limited
                                   ? "an integer from " + std::to_string(smallest) + " to " + std::to_string(largest)
                                   : "an integer of at least " + std::to_string(smallest);
  return read(key, fallback, expected, [&](const Setting& setting) {
    const auto integer = as<int>(setting);
    return integer && *integer >= smallest && *integer <= largest ? integer : std::nullopt;
  });
}

bool SettingsReader::flag(const std::string& key, bool fallback) {
  return read(key, std::make_optional(fallback), "true or false", as<bool>);
}

std::string SettingsReader::text(const std::string& key, const std::optional<std::string>& fallback) {
  return read(key, fallback, "a string", fallback ? as<std::string> : nonEmptyText);
}

std::string SettingsReader::name(const std::string& key, const std::optional<std::string>& fallback) {
  std::string value = text(key, fallback);
  if (value.size() > kMaxName || value != shownText(value)) {
    fail(key, "at most " + std::to_string(kMaxName) + " bytes without control characters");
  }
  return value;
}

int SettingsReader::choice(const std::string& key, const std::vector<std::string>& choices,
                           std::optional<int> fallback) {
  std::string expected = "one of";
  for (const std::string& choice : choices) expected += " " + choice;
  return read(key, fallback, expected, [&](const Setting& setting) -> std::optional<int> {
    const auto found = std::find(choices.begin(), choices.end(), as<std::string>(setting).value_or(""));
    if (found == choices.end()) return std::nullopt;
    return static_cast<int>(found - choices.begin());
  });
}

Vector3d SettingsReader::vector(const std::string& key, const std::optional<Vector3d>& fallback) {
  return read(key, fallback, "three finite numbers", [](const Setting& setting) -> std::optional<Vector3d> {
    const auto numbers = toList<double>(setting, 3, toNumber);
    if (!numbers) return std::nullopt;
    return Vector3d((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  });
}

std::vector<double> SettingsReader::numbers(const std::string& key, std::size_t count) {
  return read(key, std::optional<std::vector<double>>(), "a list of " + std::to_string(count) + " finite numbers",
              [&](const Setting& setting) { return toList<double>(setting, count, toNumber); });
}

std::vector<std::string> SettingsReader::texts(const std::string& key) {
  using Texts = std::vector<std::string>;
  return read(key, std::make_optional(Texts()), "a list of non-empty strings",
              [](const Setting& setting) { return toList<std::string>(setting, nonEmptyText); });
}

std::vector<std::pair<std::string, std::string>> SettingsReader::textPairs(const std::string& key) {
  using Pair = std::pair<std::string, std::string>;
  const auto toPair = [](const Setting& setting) -> std::optional<Pair> {
    const auto texts = toList<std::string>(setting, 2, nonEmptyText);
    if (!texts) return std::nullopt;
    return Pair((*texts)[0], (*texts)[1]);
  };
  return read(key, std::make_optional(std::vector<Pair>()),
              "a list of pairs of strings, as [[hand, table], [\"finger_*\", \"finger_*\"]]",
              [&](const Setting& setting) { return toList<Pair>(setting, toPair); });
}

SettingsReader SettingsReader::group(const std::string& key) {
  Setting unset;
  unset.line = group_.line;
  return {read(key, std::make_optional(unset), "a group of parameters", asGroup), pathOf(key)};
}

std::vector<SettingsReader> SettingsReader::list(const std::string& key) {
  std::vector<SettingsReader> readers;
  for (Setting& group : read(key, std::make_optional(Setting::List()), "a list of groups of parameters",
                             [](const Setting& setting) { return toList<Setting>(setting, asGroup); }))
    readers.emplace_back(std::move(group), pathOf(key) + "[" + std::to_string(readers.size()) + "]");
  return readers;
}

std::set<std::string> SettingsReader::unreadKeys() const {
  std::set<std::string> unread;
  for (const auto& member : members())
    if (read_.count(member.first) == 0) unread.insert(member.first);
  return unread;
}

std::vector<std::string> SettingsReader::unread() const {
  std::set<std::string> unset;
  for (const std::string& key : known_)
    if (members().count(key) == 0) unset.insert(key);
  std::vector<std::string> texts;
  for (const std::string& key : unreadKeys()) texts.push_back(pathOf(key) + suggestion(key, unset));
  return texts;
}

void SettingsReader::finish() const {
  const std::vector<std::string> names = unread();
  if (names.empty()) return;
  const int line = members().at(*unreadKeys().begin()).line;
  throw std::runtime_error(lineText(line) + "unknown parameter " + names.front());
}

}  // namespace sdf_ccd
