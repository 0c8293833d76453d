#include "sdf_ccd/robot/robot_scene.h"

#include <stdexcept>

#include <tinyxml2.h>

#include "common/text_limits.h"
#include "error_source.h"
#include "unexpanded_macros.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

[[noreturn]] void fail(int line, const std::string& reason) {
  throw std::runtime_error("the SRDF cannot be parsed: line " + std::to_string(line) + ": " + reason);
}

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  if (!value || !*value) fail(element.GetLineNum(), std::string(element.Name()) + " lacks the attribute " + name);
  return value;
}

Srdf readSrdf(const std::string& xml) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
    fail(document.ErrorLineNum(), document.ErrorName());
  }
  const XMLElement* robot = document.RootElement();
  if (!robot) fail(1, "it contains no element");
  if (robot->Name() != std::string("robot")) {
    fail(robot->GetLineNum(), std::string("the root element is <") + robot->Name() + ">, not <robot>");
  }

  Srdf srdf;
  if (const std::string macros = unexpandedMacros(document, "SRDF"); !macros.empty()) srdf.warnings.push_back(macros);
  if (const char* whose = robot->Attribute("name")) srdf.robot = whose;
  for (const XMLElement* element = robot->FirstChildElement(); element; element = element->NextSiblingElement()) {
    const std::string name = element->Name();
    if (name == "disable_collisions") {
      const char* reason = element->Attribute("reason");
      srdf.disabled.push_back({attribute(*element, "link1"), attribute(*element, "link2"),
                               "SRDF: " + std::string(reason && *reason ? reason : "no reason given")});
    } else if (name == "disable_default_collisions") {
      srdf.disabled_by_default.push_back(attribute(*element, "link"));
    } else if (name == "enable_collisions") {
      srdf.enabled.emplace_back(attribute(*element, "link1"), attribute(*element, "link2"));
    } else if (name == "virtual_joint") {
      srdf.virtual_joints[attribute(*element, "name")] = attribute(*element, "child_link");
    }
  }
  const bool is_empty =
      srdf.disabled.empty() && srdf.disabled_by_default.empty() && srdf.virtual_joints.empty() && srdf.enabled.empty();
  if (is_empty && robot->FirstChildElement("link"))
    srdf.warnings.push_back("the SRDF is a URDF: it has links, and nothing that is read from an SRDF");
  return srdf;
}

}  // namespace

Srdf parseSrdf(const std::string& xml, const std::string& source) {
  try {
    requireXmlSize(xml);
    return readSrdf(soundText(xml));
  } catch (const std::exception& error) {
    throwFrom(source, error);
  }
}

}  // namespace sdf_ccd
