#include "ros/parameters/yaml_parameters.h"

#include <cerrno>
#include <cstdlib>
#include <limits>
#include <optional>
#include <regex>
#include <set>
#include <stdexcept>

#include "common/read_number.h"
#include "common/text_limits.h"
#include "storage/regular_file.h"
#include "yaml/load_yaml.h"

namespace sdf_ccd {
namespace {

using XmlRpc::XmlRpcValue;

[[noreturn]] void refuse(const YAML::Mark& mark, const std::string& reason) {
  throw std::runtime_error("line " + std::to_string(mark.line + 1) + ": " + reason);
}

bool toInteger(const std::string& text, int& number) {
  static const std::regex kInteger("[-+]?(0|[1-9][0-9]*|0[0-7]+|0x[0-9a-fA-F]+)");
  if (!std::regex_match(text, kInteger)) return false;
  errno = 0;
  const long value = std::strtol(text.c_str(), nullptr, 0);
  number = static_cast<int>(value);
  return errno == 0 && value == number;
}

bool toReal(const std::string& text, double& number) {
  static const std::regex kReal("[-+]?([0-9]+\\.[0-9]*|\\.[0-9]+)([eE][-+][0-9]+)?");
  if (!std::regex_match(text, kReal)) return false;
  const std::optional<double> read = wholeNumber(text);
  number = read.value_or(0.0);
  return read.has_value();
}

XmlRpcValue toScalar(const YAML::Node& node) {
  static const std::set<std::string> kTrue = {"yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"};
  static const std::set<std::string> kFalse = {"no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"};
  const std::string& text = node.Scalar();
  constexpr std::size_t kMaxNumber = 400;                              // bytes: regular expressions recurse for each
  const bool is_text = node.Tag() == "!" || text.size() > kMaxNumber;  // the tag says that it is quoted
  int integer = 0;
  double real = 0.0;
  if (is_text) return XmlRpcValue(text);
  if (kTrue.count(text) + kFalse.count(text) > 0) return XmlRpcValue(kTrue.count(text) > 0);
  if (toInteger(text, integer)) return XmlRpcValue(integer);
  if (toReal(text, real)) return XmlRpcValue(real);
  return XmlRpcValue(text);
}

/// Converts nodes to values. It counts values after anchors and aliases are expanded: a few lines can expand to 10⁹
/// values, or endlessly.
class ValueReader {
 public:
  XmlRpcValue value(const YAML::Node& node) {
    constexpr int kMaxValues = 100'000;
    if (++values_ > kMaxValues) refuse(node.Mark(), "more than " + std::to_string(kMaxValues) + " values");
    enter(node);
    XmlRpcValue made = node.IsScalar() ? toScalar(node) : node.IsSequence() ? sequence(node) : structure(node);
    --levels_;
    return made;
  }

 private:
  void enter(const YAML::Node& node) {
    if (++levels_ > kMaxYamlDepth)
      refuse(node.Mark(), "nested more than " + std::to_string(kMaxYamlDepth) + " levels deep");
  }

  XmlRpcValue sequence(const YAML::Node& node) {
    XmlRpcValue made;
    made.setSize(static_cast<int>(node.size()));
    for (std::size_t i = 0; i < node.size(); ++i) made[static_cast<int>(i)] = value(node[i]);
    return made;
  }

  XmlRpcValue structure(const YAML::Node& node) {
    if (!node.IsMap()) refuse(node.Mark(), "a value is missing");
    XmlRpcValue made;
    made.begin();  // makes it a struct, also without members
    for (const auto& member : node) {
      if (!member.first.IsScalar()) refuse(member.first.Mark(), "the name of a parameter is not a string");
      if (member.second.IsNull()) refuse(member.first.Mark(), "parameter " + member.first.Scalar() + " has no value");
      setMember(made, member.first, member.first.Scalar(), member.second);
    }
    return made;
  }

  /// @param key  the rest of `name`; a slash leads into a nested struct.
  void setMember(XmlRpcValue& tree, const YAML::Node& name, const std::string& key, const YAML::Node& node) {
    if (tree.valid() && tree.getType() != XmlRpcValue::TypeStruct) {
      refuse(name.Mark(), "parameter " + name.Scalar() + " is inside a parameter that is a value, not a group");
    }
    const std::size_t slash = key.find('/');
    if (slash == std::string::npos) {
      if (tree.hasMember(key)) refuse(name.Mark(), "parameter " + name.Scalar() + " is set twice");
      tree[key] = value(node);
      return;
    }
    enter(name);
    setMember(tree[key.substr(0, slash)], name, key.substr(slash + 1), node);
    --levels_;
  }

  int values_ = 0, levels_ = 0;
};

}  // namespace

XmlRpcValue loadYamlParameters(const std::string& file) {
  return parseYamlParameters(readNamedFile(file, kMaxYamlBytes), file);
}

XmlRpcValue parseYamlParameters(const std::string& text, const std::string& file) {
  try {
    const YAML::Node document = loadYaml(text);
    if (document.IsNull()) return {};
    if (!document.IsMap()) refuse(document.Mark(), "expected parameters, as in config/monitor.yaml");
    return ValueReader().value(document);
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

}  // namespace sdf_ccd
