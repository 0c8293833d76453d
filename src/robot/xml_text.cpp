#include "xml_text.h"

#include <stdexcept>

#include "common/shown_text.h"
#include "common/text_limits.h"

namespace sdf_ccd {
namespace {

bool hasExpression(const tinyxml2::XMLElement& element) {
  for (const tinyxml2::XMLAttribute* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next())
    if (std::string(attribute->Value()).find("${") != std::string::npos) return true;
  return false;
}

}  // namespace

tinyxml2::XMLElement& parseRobotXml(const std::string& xml, tinyxml2::XMLDocument& document) {
  requireXmlSize(xml);
  const std::string text = soundText(xml);
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
    throw std::runtime_error("line " + std::to_string(document.ErrorLineNum()) + ": " + document.ErrorName());
  if (tinyxml2::XMLElement* robot = document.FirstChildElement("robot")) return *robot;
  const tinyxml2::XMLElement* root = document.RootElement();
  throw std::runtime_error("its root is " + (root ? "<" + shownText(root->Name()) + ">" : "missing") + ", not <robot>");
}

std::string unexpandedMacro(const tinyxml2::XMLElement& element, const std::string& kind) {
  const std::string name = element.Name();
  if (name == "xacro:macro" || name == "xacro:property" || name == "xacro:arg") return {};
  if (name.rfind("xacro:", 0) == 0 || hasExpression(element))
    return "line " + std::to_string(element.GetLineNum()) + " of the " + kind +
           ": xacro has not expanded it, and what it stands for is missing";
  for (auto child = element.FirstChildElement(); child; child = child->NextSiblingElement())
    if (std::string macro = unexpandedMacro(*child, kind); !macro.empty()) return macro;
  return {};
}

}  // namespace sdf_ccd
