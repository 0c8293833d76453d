#include "common/settings/yaml_settings.h"

#include <cerrno>
#include <cstdlib>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include "common/files/regular_file.h"
#include "common/read_number.h"
#include "common/text_limits.h"

namespace sdf_ccd {
namespace {

constexpr int kMaxDepth = 64, kMaxValues = 100'000;

std::string atLine(int line, const std::string& reason) {
  return "line " + std::to_string(line) + ": " + reason;
}

[[noreturn]] void refuseAt(int line, const std::string& reason) {
  throw std::runtime_error(atLine(line, reason));
}

std::optional<int> toInteger(const std::string& text) {
  static const std::regex kInteger("[-+]?(0|[1-9][0-9]*|0[0-7]+|0x[0-9a-fA-F]+)");
  if (!std::regex_match(text, kInteger)) return std::nullopt;
  errno = 0;
  const long value = std::strtol(text.c_str(), nullptr, 0);
  const int number = static_cast<int>(value);
  return errno == 0 && value == number ? std::make_optional(number) : std::nullopt;
}

std::optional<double> toReal(const std::string& text) {
  static const std::regex kReal("[-+]?([0-9]+\\.[0-9]*|\\.[0-9]+)([eE][-+][0-9]+)?");
  return std::regex_match(text, kReal) ? wholeNumber(text) : std::nullopt;
}

/// A plain scalar, with the type that it looks like.
Setting plain(const std::string& text) {
  static const std::set<std::string> kTrue = {"yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"};
  static const std::set<std::string> kFalse = {"no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"};
  constexpr std::size_t kMaxNumber = 400;  // bytes: regular expressions recurse for each
  if (text.size() > kMaxNumber) return {text};
  if (kTrue.count(text) + kFalse.count(text) > 0) return {kTrue.count(text) > 0};
  if (const auto integer = toInteger(text)) return {*integer};
  if (const auto real = toReal(text)) return {*real};
  return {text};
}

int valuesIn(const Setting& setting) {
  int values = 1;
  if (const auto* list = std::get_if<Setting::List>(&setting.value))
    for (const Setting& item : *list) values += valuesIn(item);
  if (const auto* group = std::get_if<Setting::Group>(&setting.value))
    for (const auto& member : *group) values += valuesIn(member.second);
  return values;
}

/// Builds the settings from the parser's events. The parser recurses for each nested level, so depth is limited here,
/// while it reads.
class SettingBuilder : public YAML::EventHandler {
 public:
  using Mark = YAML::Mark;
  using Anchor = YAML::anchor_t;
  using Style = YAML::EmitterStyle::value;

  explicit SettingBuilder(Setting& root) : root_(root) {}

  void OnDocumentStart(const Mark&) override {}
  void OnDocumentEnd() override {
    if (!missing_.empty()) throw std::runtime_error(missing_);
  }
  void OnNull(const Mark& mark, Anchor) override {
    if (levels_.empty()) return;  // an empty document
    const Level& level = levels_.back();
    if (missing_.empty())
      missing_ = level.name ? atLine(level.name_line, "parameter " + *level.name + " has no value")
                            : atLine(lineOf(mark), "a value is missing");
    add({}, lineOf(mark));
  }
  void OnAlias(const Mark& mark, Anchor anchor) override {
    const auto found = anchored_.find(anchor);
    if (found == anchored_.end()) refuseAt(lineOf(mark), "a value contains itself");
    count(valuesIn(found->second), lineOf(mark));
    add(found->second, lineOf(mark));
  }
  void OnScalar(const Mark& mark, const std::string& tag, Anchor anchor, const std::string& text) override {
    const bool is_name = !levels_.empty() && levels_.back().made.isGroup() && !levels_.back().name;
    if (is_name) {
      levels_.back().name = text;
      levels_.back().name_line = lineOf(mark);
      return;
    }
    count(1, lineOf(mark));
    Setting made = tag == "!" ? Setting{text} : plain(text);  // the tag says that it is quoted
    made.line = lineOf(mark);
    close(std::move(made), anchor);
  }
  void OnSequenceStart(const Mark& mark, const std::string&, Anchor anchor, Style) override {
    open({Setting::List(), lineOf(mark)}, anchor);
  }
  void OnSequenceEnd() override { closeLevel(); }
  void OnMapStart(const Mark& mark, const std::string&, Anchor anchor, Style) override {
    open({Setting::Group(), lineOf(mark)}, anchor);
  }
  void OnMapEnd() override { closeLevel(); }

 private:
  /// A list or group that is being read.
  struct Level {
    Setting made;
    Anchor anchor;
    std::optional<std::string> name = {};  // of the next member
    int name_line = 0;
  };

  static int lineOf(const Mark& mark) { return mark.line + 1; }

  void count(int values, int line) {
    values_ += values;
    if (values_ > kMaxValues) refuseAt(line, "more than " + std::to_string(kMaxValues) + " values");
  }
  static void requireDepth(std::size_t depth, int line) {
    if (depth > kMaxDepth) refuseAt(line, "nested more than " + std::to_string(kMaxDepth) + " levels deep");
  }

  void open(Setting made, Anchor anchor) {
    count(1, made.line);
    requireDepth(levels_.size() + 1, made.line);
    levels_.push_back({std::move(made), anchor});
  }
  void closeLevel() {
    Level level = std::move(levels_.back());
    levels_.pop_back();
    close(std::move(level.made), level.anchor);
  }
  void close(Setting made, Anchor anchor) {
    const int line = made.line;
    if (anchor != 0) {
      count(valuesIn(made), line);
      anchored_[anchor] = made;
    }
    add(std::move(made), line);
  }

  void add(Setting made, int line) {
    if (levels_.empty()) {
      root_ = std::move(made);
    } else if (auto* list = std::get_if<Setting::List>(&levels_.back().made.value)) {
      list->push_back(std::move(made));
    } else {
      Level& level = levels_.back();
      if (!level.name) refuseAt(line, "the name of a parameter is not a string");
      addMember(level.made, *level.name, std::move(made), level.name_line);
      level.name.reset();
    }
  }

  /// A slash in a name leads into a nested group.
  void addMember(Setting& group, const std::string& name, Setting made, int line) {
    Setting* tree = &group;
    std::size_t begin = 0, depth = levels_.size();
    for (std::size_t slash; (slash = name.find('/', begin)) != std::string::npos; begin = slash + 1) {
      requireDepth(++depth, line);
      tree = &std::get<Setting::Group>(tree->value)[name.substr(begin, slash - begin)];
      if (!tree->isGroup()) refuseAt(line, "parameter " + name + " is inside a parameter that is a value, not a group");
    }
    const bool is_new = std::get<Setting::Group>(tree->value).emplace(name.substr(begin), std::move(made)).second;
    if (!is_new) refuseAt(line, "parameter " + name + " is set twice");
  }

  Setting& root_;
  std::vector<Level> levels_;
  std::map<Anchor, Setting> anchored_;
  std::string missing_;  // the first value that is missing: told at the end, as an open bracket looks the same
  int values_ = 0;
};

}  // namespace

Setting parseYaml(const std::string& text) {
  std::istringstream stream(text);
  Setting settings;
  SettingBuilder builder(settings);
  YAML::Parser(stream).HandleNextDocument(builder);
  if (!settings.isGroup()) refuseAt(settings.line, "expected parameters, each with its name");
  return settings;
}

Setting loadYaml(const std::string& file) {
  try {
    return parseYaml(readNamedFile(file, kMaxYamlBytes));
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

}  // namespace sdf_ccd
