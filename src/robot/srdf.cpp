#include "sdf_ccd/robot/robot_scene.h"

#include <cmath>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>

#include <tinyxml2.h>

#include "common/text_limits.h"
#include "error_source.h"

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

/// The number in a joint's value; empty if it has several, as for planar and floating joints.
std::optional<double> jointValue(const XMLElement& joint) {
  const std::string text = attribute(joint, "value");
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  int count = 0;
  double value = 0.0;
  for (double next; stream >> next; ++count) value = next;
  if (count == 0 || !stream.eof() || !std::isfinite(value)) {
    fail(joint.GetLineNum(), "joint " + attribute(joint, "name") + ": value \"" + text + "\" is no number");
  }
  return count == 1 ? std::make_optional(value) : std::nullopt;
}

JointPositions readState(const XMLElement& state) {
  JointPositions positions;
  for (const XMLElement* joint = state.FirstChildElement("joint"); joint; joint = joint->NextSiblingElement("joint")) {
    const std::optional<double> value = jointValue(*joint);
    if (value) positions[attribute(*joint, "name")] = *value;
  }
  return positions;
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
    } else if (name == "group_state") {
      const char* group = element->Attribute("group");
      const std::string state = attribute(*element, "name");
      srdf.states[group && *group ? group + ("/" + state) : state] = readState(*element);
    }
  }
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
