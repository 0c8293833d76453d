#include "unread_shapes.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "common/shown_text.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;
using Names = std::set<std::string>;

std::string inLowerCase(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

/// Elements of these names hold others' collision elements.
bool isExtension(const std::string& name) {
  return name == "gazebo" || name == "material" || name.rfind("xacro:", 0) == 0;
}

/// Whether an element is a collision shape, wherever it stands.
bool isShape(const XMLElement& element) {
  return inLowerCase(element.Name()) == "collision" && element.FirstChildElement("geometry");
}

/// Whether a text is of numbers, and not all of them are 0: a place or a rotation.
bool isPlacing(const char* text) {
  const std::string numbers = text ? text : "";
  return numbers.find_first_of("123456789") != std::string::npos &&
         numbers.find_first_not_of("0123456789+-.eE, \t\r\n") == std::string::npos;
}

bool hasUnknownPlace(const XMLElement& element, const Names& attributes) {
  for (const tinyxml2::XMLAttribute* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next())
    if (attributes.count(attribute->Name()) == 0 && isPlacing(attribute->Value())) return true;
  return false;
}

std::string unread(const XMLElement& element) {
  const tinyxml2::XMLNode* parent = element.Parent();
  return "line " + std::to_string(element.GetLineNum()) + " of the URDF: <" + shownText(element.Name()) + "> in <" +
         shownText(parent->Value()) + "> is not read";
}

/// Whether urdfdom reads a part of a link, a collision element or a geometry.
bool isRead(const XMLElement& part, const std::string& parent) {
  const std::string name = part.Name();
  if (parent == "link") return name == "collision";
  if (part.PreviousSiblingElement(parent == "geometry" ? nullptr : part.Name())) return false;
  return parent == "geometry" || name == "origin" || name == "geometry";
}

/// Whether a part that is not read would be, or place, a shape.
bool matters(const XMLElement& part, const std::string& parent) {
  static const Names shapes = {"collision", "geometry", "box", "sphere", "cylinder", "capsule", "mesh"};
  const std::string name = inLowerCase(part.Name());
  const bool is_place = parent == "collision" && (name == "origin" || (name == "pose" && isPlacing(part.GetText())));
  return parent == "geometry" || shapes.count(name) > 0 || is_place;
}

/// @param is_read  whether all of the parent's elements matter; otherwise only whole shapes.
std::string firstUnread(const XMLElement& parent, bool is_read) {
  for (auto element = parent.FirstChildElement(); element; element = element->NextSiblingElement()) {
    const std::string name = element->Name();
    if (isExtension(inLowerCase(name))) continue;
    const bool is_part = is_read && isRead(*element, parent.Name());
    if (!is_part && (is_read ? matters(*element, parent.Name()) : isShape(*element))) return unread(*element);
    if (is_part && (name == "origin" || name == "mesh")) {
      const Names attributes = name == "origin" ? Names{"xyz", "rpy"} : Names{"filename", "scale"};
      if (hasUnknownPlace(*element, attributes)) return unread(*element) + " in full";
    }
    if (std::string below = firstUnread(*element, is_part); !below.empty()) return below;
  }
  return {};
}

void addOutsideLinks(const tinyxml2::XMLNode& parent, const XMLElement& robot, std::vector<std::string>& lines) {
  constexpr std::size_t kMost = 10;
  for (auto element = parent.FirstChildElement(); element && lines.size() < kMost;
       element = element->NextSiblingElement()) {
    if (isExtension(inLowerCase(element->Name()))) continue;
    if (&parent == &robot && element->Name() == std::string("link")) continue;
    if (isShape(*element)) return lines.push_back(unread(*element));
    addOutsideLinks(*element, robot, lines);
  }
}

}  // namespace

std::string unreadShape(const XMLElement& link) {
  return firstUnread(link, true);
}

std::vector<std::string> shapesOutsideLinks(const XMLElement& robot) {
  std::vector<std::string> lines;
  addOutsideLinks(*robot.GetDocument(), robot, lines);
  return lines;
}

}  // namespace sdf_ccd
