#include "misplaced_elements.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "common/shown_text.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

/// Elements that say which shapes a robot has, and where they are; by name, what they belong in.
const std::map<std::string, std::set<std::string>> kParents = {{"link", {"robot"}},
                                                               {"joint", {"robot"}},
                                                               {"collision", {"link"}},
                                                               {"geometry", {"collision", "visual"}},
                                                               {"box", {"geometry"}},
                                                               {"sphere", {"geometry"}},
                                                               {"cylinder", {"geometry"}},
                                                               {"capsule", {"geometry"}},
                                                               {"mesh", {"geometry"}},
                                                               {"origin", {"collision", "inertial", "joint", "visual"}},
                                                               {"parent", {"joint"}},
                                                               {"child", {"joint"}},
                                                               {"axis", {"joint"}},
                                                               {"limit", {"joint"}},
                                                               {"mimic", {"joint"}}};

std::string inLowerCase(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

/// Whether a text is of numbers, and not all of them are 0: a place or a rotation.
bool isPlacing(const std::string& text) {
  return text.find_first_of("123456789") != std::string::npos &&
         text.find_first_not_of("0123456789+-.eE, \t\r\n") == std::string::npos;
}

/// What an element says in an attribute that urdfdom does not read though it places or scales something; empty if there
/// is none.
std::string ignoredAttribute(const XMLElement& element, const std::string& name_in_lower_case) {
  static const std::map<std::string, std::array<std::string, 2>> attributes = {{"mesh", {"filename", "scale"}},
                                                                               {"origin", {"xyz", "rpy"}}};
  const auto read = attributes.find(name_in_lower_case);
  if (read == attributes.end()) return {};
  const auto& [first, second] = read->second;
  for (const tinyxml2::XMLAttribute* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next()) {
    const std::string name = attribute->Name(), value = attribute->Value();
    if (!isPlacing(value) || name == first || name == second) continue;
    const std::string written = shownText(fmt::format("{}=\"{}\"", name, value));
    return fmt::format("has {}, which is ignored: its attributes are {} and {}", written, first, second);
  }
  return {};
}

/// Why urdfdom ignores an element of one of these names, or what it says; empty if it does not.
std::string whyIgnored(const XMLElement& element, const std::string& parent) {
  const std::string written = element.Name(), name = inLowerCase(written);
  const std::string line =
      "line " + std::to_string(element.GetLineNum()) + " of the URDF: <" + shownText(written) + "> ";
  const bool is_shape = parent == "geometry";  // whatever its name
  if (is_shape && element.PreviousSiblingElement()) return line + "is ignored: its <geometry> has a shape already";
  if (name == "robot") return line + "is ignored: the URDF has one already";
  if (name == "pose") {  // of SDFormat
    if (!element.GetText() || !isPlacing(element.GetText())) return {};
    const bool has_place = kParents.at("origin").count(parent) > 0;
    return line + "in <" + shownText(parent) + "> is ignored: " +
           (has_place ? "it must be <origin xyz=\"...\" rpy=\"...\">" : "links are placed by the <origin> of joints");
  }
  const auto known = kParents.find(name);
  if (known == kParents.end()) return {};
  if (known->second.count(inLowerCase(parent)) == 0) {
    std::string places;
    for (const std::string& place : known->second) places += (places.empty() ? "<" : " or <") + place + ">";
    return line + "in <" + shownText(parent) + "> is ignored: it belongs in " + places;
  }
  if (!is_shape) {  // the parser reports shapes that it cannot read
    if (written != name) return line + "is ignored: it must be <" + name + ">";
    const bool can_be_many = name == "link" || name == "joint" || name == "collision";
    if (!can_be_many && element.PreviousSiblingElement(name.c_str()))
      return line + "is ignored: its <" + parent + "> has one already";
  }
  const std::string attribute = ignoredAttribute(element, name);
  return attribute.empty() ? "" : line + attribute;
}

/// Whether an element with this name holds a shape, or is one.
bool isOfShape(const std::string& name_in_lower_case) {
  static const std::set<std::string> names = {"collision", "geometry", "box", "sphere", "cylinder", "capsule", "mesh"};
  return names.count(name_in_lower_case) > 0;
}

/// Whether what is inside an element of this name is no part of the robot: Gazebo's elements have the same names.
bool isExtension(const std::string& name_in_lower_case) {
  return name_in_lower_case == "gazebo" || name_in_lower_case == "material";
}

/// Whether an element of this name is a part of a robot wherever it stands: other formats' have less inside.
bool isWhole(const XMLElement& element, const std::string& name_in_lower_case) {
  const auto has = [&](const char* inside) { return element.FirstChildElement(inside) != nullptr; };
  if (name_in_lower_case == "collision") return has("geometry");
  if (name_in_lower_case == "link") return has("collision") || has("visual") || has("inertial");
  if (name_in_lower_case == "joint") return has("parent") && has("child");
  return name_in_lower_case == "robot" && (has("link") || has("joint"));
}

/// @param is_read  whether all of the parent's elements matter; otherwise only whole collision elements.
std::string firstIgnored(const XMLElement& parent, bool is_read) {
  for (auto element = parent.FirstChildElement(); element; element = element->NextSiblingElement()) {
    const std::string name = element->Name(), lower = inLowerCase(name);
    if (isExtension(lower)) continue;
    // What else a link should not have, such as an origin of its own, moves no shape for any reader.
    const bool matters = is_read && (isOfShape(lower) || parent.Name() != std::string("link"));
    if (matters || (lower == "collision" && isWhole(*element, lower))) {
      if (std::string why = whyIgnored(*element, parent.Name()); !why.empty()) return why;
    }
    const bool is_read_below = is_read && (name == "collision" || name == "geometry");
    if (std::string why = firstIgnored(*element, is_read_below); !why.empty()) return why;
  }
  return {};
}

/// Lines about elements that urdfdom ignores: the first ten.
class IgnoredElements {
 public:
  void add(const XMLElement& element, const std::string& whose) {
    constexpr std::size_t kMost = 10;
    if (lines_.size() >= kMost) return;
    const XMLElement* parent = element.Parent()->ToElement();
    if (const std::string why = whyIgnored(element, parent ? parent->Name() : ""); !why.empty())
      lines_.push_back(whose + why);
  }

  /// Adds links, joints and shapes below an element of the robot that is no link.
  void addBelow(const XMLElement& unknown, const std::string& whose) {
    const std::string name = inLowerCase(unknown.Name());
    if (isExtension(name) || name.rfind("xacro:", 0) == 0) return;
    for (auto element = unknown.FirstChildElement(); element; element = element->NextSiblingElement()) {
      const std::string kind = inLowerCase(element->Name());
      if (!isWhole(*element, kind)) {
        addBelow(*element, whose);
        continue;
      }
      const char* its_name = kind == "link" || kind == "joint" ? element->Attribute("name") : nullptr;
      add(*element, its_name ? kind + " " + shownText(its_name) + ": " : whose);
    }
  }

  std::vector<std::string> take() { return std::move(lines_); }

 private:
  std::vector<std::string> lines_;
};

}  // namespace

std::string misplacedShape(const XMLElement& link) {
  return firstIgnored(link, true);
}

std::vector<std::string> misplacedElements(const XMLElement& robot) {
  IgnoredElements ignored;
  for (auto root = robot.Parent()->FirstChildElement(); root; root = root->NextSiblingElement())
    if (root != &robot && inLowerCase(root->Name()) == "robot") ignored.add(*root, "");
  for (auto element = robot.FirstChildElement(); element; element = element->NextSiblingElement()) {
    ignored.add(*element, "");
    const std::string kind = element->Name();
    const char* name = element->Attribute("name");
    const bool is_read = (kind == "joint" || kind == "link") && name;
    const std::string whose = is_read ? kind + " " + shownText(name) + ": " : "";
    if (inLowerCase(kind) != "link") ignored.addBelow(*element, whose);
    for (auto part = is_read ? element->FirstChildElement() : nullptr; part; part = part->NextSiblingElement()) {
      const std::string of_part = inLowerCase(part->Name());
      const bool is_added = kind == "joint" && isWhole(*part, of_part);
      if (!isOfShape(of_part) && !is_added) ignored.add(*part, whose);
    }
  }
  return ignored.take();
}

}  // namespace sdf_ccd
