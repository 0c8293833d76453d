#include "readable_link.h"

#include <exception>
#include <string>

#include <fmt/format.h>
#include <urdf_model/pose.h>
#include <urdf_model/utils.h>

#include "urdf_geometry.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

std::string attribute(const XMLElement* element, const char* name, const char* fallback) {
  const char* value = element ? element->Attribute(name) : nullptr;
  return value ? value : fallback;
}

XMLElement* insertShape(const char* shape, XMLElement& parent, XMLElement*& after, const char* kind) {
  XMLElement* element = parent.GetDocument()->NewElement(kind);
  if (after) {
    parent.InsertAfterChild(after, element);
  } else {
    parent.InsertEndChild(element);
  }
  after = element;
  XMLElement* made = parent.GetDocument()->NewElement(shape);
  element->InsertEndChild(parent.GetDocument()->NewElement("geometry"))->InsertEndChild(made);
  return made;
}

/// Replaces a collision element whose shape is a capsule. @throws std::exception if a number is none.
void replaceCapsule(XMLElement& link, XMLElement& collision, const XMLElement& capsule) {
  const XMLElement* origin = collision.FirstChildElement("origin");
  urdf::Pose pose;
  pose.position.init(attribute(origin, "xyz", "0 0 0"));
  pose.rotation.init(attribute(origin, "rpy", "0 0 0"));
  const std::string radius = attribute(&capsule, "radius", ""), length = attribute(&capsule, "length", "");
  const double half = urdf::strToDouble(length.c_str()) / 2.0;
  urdf::strToDouble(radius.c_str());
  if (!(half >= 0.0)) return;  // the parser reports the capsule
  const Isometry3d X_BC = toEigen(pose);
  XMLElement* last = &collision;
  for (const double side : {-1.0, 1.0}) {
    insertShape("sphere", link, last, "collision")->SetAttribute("radius", radius.c_str());
    const Vector3d p_B = X_BC * Vector3d(0.0, 0.0, side * half);
    XMLElement* at = link.GetDocument()->NewElement("origin");
    at->SetAttribute("xyz", fmt::format("{} {} {}", p_B.x(), p_B.y(), p_B.z()).c_str());
    last->InsertFirstChild(at);
    if (half == 0.0) break;
  }
  if (half > 0.0) {
    XMLElement* cylinder = insertShape("cylinder", link, last, "collision");
    cylinder->SetAttribute("radius", radius.c_str());
    cylinder->SetAttribute("length", length.c_str());
    if (origin) last->InsertFirstChild(origin->DeepClone(link.GetDocument()));
  }
  link.DeleteChild(&collision);
}

}  // namespace

std::string linkName(const XMLElement& link) {
  const std::string name = attribute(&link, "name", "");
  return name.empty() ? "unnamed link of line " + std::to_string(link.GetLineNum()) : name;
}

void makeReadable(XMLElement& link) {
  bool is_seen = false;
  for (const char* kind : {"visual", "inertial"}) {
    while (XMLElement* unread = link.FirstChildElement(kind)) {
      const XMLElement* geometry = unread->FirstChildElement("geometry");
      is_seen |= geometry && geometry->FirstChildElement();
      link.DeleteChild(unread);
    }
  }
  XMLElement* none = nullptr;
  if (is_seen) insertShape("sphere", link, none, "visual")->SetAttribute("radius", "1");

  for (XMLElement* collision = link.FirstChildElement("collision"); collision;) {
    XMLElement* next = collision->NextSiblingElement("collision");
    const XMLElement* geometry = collision->FirstChildElement("geometry");
    const XMLElement* shape = geometry ? geometry->FirstChildElement() : nullptr;
    if (shape && shape->Name() == std::string("capsule")) {
      try {
        replaceCapsule(link, *collision, *shape);
      } catch (const std::exception&) {
        // Left as it is: the parser reports it, as for any shape whose numbers are none.
      }
    }
    collision = next;
  }
}

}  // namespace sdf_ccd
