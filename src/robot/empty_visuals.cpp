#include "empty_visuals.h"

namespace sdf_ccd {

void removeEmptyVisuals(tinyxml2::XMLElement& link) {
  for (tinyxml2::XMLElement* visual = link.FirstChildElement("visual"); visual;) {
    tinyxml2::XMLElement* next = visual->NextSiblingElement("visual");
    const tinyxml2::XMLElement* geometry = visual->FirstChildElement("geometry");
    if (!geometry || !geometry->FirstChildElement()) link.DeleteChild(visual);
    visual = next;
  }
}

}  // namespace sdf_ccd
