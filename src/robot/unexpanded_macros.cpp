#include "unexpanded_macros.h"

#include <vector>

#include "common/counted.h"
#include "common/shown_text.h"

namespace sdf_ccd {
namespace {

/// The first attribute that holds an expression of xacro; empty if none does.
std::string unexpandedValue(const tinyxml2::XMLElement& element) {
  for (const tinyxml2::XMLAttribute* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next()) {
    const std::string value = attribute->Value();
    if (value.find("${") != std::string::npos) return std::string(attribute->Name()) + "=\"" + value + "\"";
  }
  return {};
}

}  // namespace

std::string unexpandedMacros(const tinyxml2::XMLDocument& document, const std::string& kind) {
  const auto isDefinition = [](const std::string& name) {
    return name == "xacro:macro" || name == "xacro:property" || name == "xacro:arg";
  };
  std::string first;
  std::size_t count = 0;
  std::vector<const tinyxml2::XMLElement*> left = {document.RootElement()};
  while (!left.empty()) {
    const tinyxml2::XMLElement* element = left.back();
    left.pop_back();
    if (!element) continue;
    const std::string name = element->Name();
    left.push_back(element->NextSiblingElement());
    if (isDefinition(name)) continue;
    left.push_back(element->FirstChildElement());
    const std::string value = unexpandedValue(*element);
    if (name.rfind("xacro:", 0) != 0 && value.empty()) continue;
    if (++count > 1) continue;
    first = "line " + std::to_string(element->GetLineNum()) + ": " +
            (value.empty() ? "<" + shownText(name) + "> is ignored" : shownText(value) + " is taken as it is");
  }
  if (count == 0) return {};
  const std::string others = count == 1 ? "" : " with " + counted(count - 1, "other");
  return "the " + kind + "'s " + first + others + ": xacro has not expanded it, and what it stands for is missing";
}

}  // namespace sdf_ccd
