#include "sdf_ccd/robot/robot_scene.h"

#include <stdexcept>

#include <tinyxml2.h>

#include "common/text_limits.h"
#include "error_source.h"
#include "unexpanded_macros.h"
#include "xml_error.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

[[noreturn]] void fail(const std::string& reason) {
  throw std::runtime_error("the SRDF cannot be parsed: " + reason);
}

[[noreturn]] void fail(int line, const std::string& reason) {
  fail("line " + std::to_string(line) + ": " + reason);
}

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  if (!value || !*value) fail(element.GetLineNum(), std::string(element.Name()) + " lacks the attribute " + name);
  return value;
}

bool isAboutCollisions(const std::string& name) {
  return name == "disable_collisions" || name == "disable_default_collisions" || name == "enable_collisions";
}

/// The first element about collisions inside another one, where none is read: in a group, for example. Null if none is.
const XMLElement* misplaced(const XMLElement& robot) {
  for (const XMLElement* outer = robot.FirstChildElement(); outer; outer = outer->NextSiblingElement())
    for (const XMLElement* inner = outer->FirstChildElement(); inner; inner = inner->NextSiblingElement())
      if (isAboutCollisions(inner->Name())) return inner;
  return nullptr;
}

Srdf readSrdf(const std::string& xml) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) fail(xmlError(document));
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
  if (const XMLElement* lost = misplaced(*robot))
    srdf.warnings.push_back("line " + std::to_string(lost->GetLineNum()) + " of the SRDF: " + lost->Name() +
                            " is not read, as it is inside <" + lost->Parent()->Value() + ">: move it out of it");
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
