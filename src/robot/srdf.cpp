#include "sdf_ccd/robot.h"

#include <initializer_list>
#include <stdexcept>

#include "common/shown_text.h"
#include "common/text_limits.h"
#include "error_source.h"
#include "scene/pair_rules.h"
#include "xml_text.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value ? soundText(value) : "";
}

/// Reads elements with what they need to say. One that does not say it costs nothing else.
class ElementReader {
 public:
  explicit ElementReader(Srdf& srdf) : srdf_(srdf) {}

  void read(const XMLElement& element) {
    const std::string name = element.Name();
    if (name == "disable_collisions") {
      if (const std::string why = whyNoPair(element); !why.empty()) return warn(element, why + ", and is ignored");
      const std::string reason = attribute(element, "reason");
      srdf_.disabled.push_back({attribute(element, "link1"), attribute(element, "link2"),
                                "SRDF: " + (reason.empty() ? "no reason given" : reason), PairKind::kSrdf});
    } else if (name == "disable_default_collisions") {
      if (has(element, "link")) srdf_.disabled_by_default.push_back(attribute(element, "link"));
    } else if (name == "enable_collisions") {
      const std::string lack = lacks(element, {"link1", "link2"});
      if (!lack.empty()) warn(element, lack + ", and counts for all links");
      const auto linkAt = [&](const char* end) {
        return attribute(element, end).empty() ? "*" : attribute(element, end);
      };
      srdf_.enabled.emplace_back(linkAt("link1"), linkAt("link2"));
    } else if (name == "virtual_joint") {
      if (has(element, "name") && has(element, "child_link"))
        srdf_.virtual_joints[attribute(element, "name")] = attribute(element, "child_link");
    }
  }

 private:
  static std::string lacks(const XMLElement& element, std::initializer_list<const char*> attributes) {
    for (const char* name : attributes)
      if (attribute(element, name).empty()) return std::string("lacks the attribute ") + name;
    return {};
  }

  static std::string whyNoPair(const XMLElement& element) {
    const std::string lack = lacks(element, {"link1", "link2"}), link = attribute(element, "link1");
    if (!lack.empty() || isPattern(link) || link != attribute(element, "link2")) return lack;
    return "names the link " + shownText(link) + " twice";
  }

  bool has(const XMLElement& element, const char* name) {
    const std::string lack = lacks(element, {name});
    if (!lack.empty()) warn(element, lack + ", and is ignored");
    return lack.empty();
  }

  void warn(const XMLElement& element, const std::string& what) {
    srdf_.warnings.push_back("line " + std::to_string(element.GetLineNum()) + " of the SRDF: " + element.Name() + " " +
                             what);
  }

  Srdf& srdf_;
};

Srdf readSrdf(const std::string& xml) {
  tinyxml2::XMLDocument document;
  const XMLElement& robot = parseRobotXml(xml, document);
  Srdf srdf;
  if (const std::string macro = unexpandedMacro(robot, "SRDF"); !macro.empty()) srdf.warnings.push_back(macro);
  if (const char* whose = robot.Attribute("name")) srdf.robot = whose;
  ElementReader reader(srdf);
  for (const XMLElement* element = robot.FirstChildElement(); element; element = element->NextSiblingElement())
    reader.read(*element);
  return srdf;
}

}  // namespace

Srdf parseSrdf(const std::string& xml, const std::string& source) {
  try {
    return readSrdf(xml);
  } catch (const std::exception& error) {
    throwFrom(source, std::runtime_error(std::string("the SRDF cannot be parsed: ") + error.what()));
  }
}

}  // namespace sdf_ccd
