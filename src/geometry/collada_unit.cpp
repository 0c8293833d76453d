#include "collada_unit.h"

#include <cmath>
#include <stdexcept>

#include <tinyxml2.h>

namespace sdf_ccd {

double colladaUnit(const std::string& xml) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error("not well-formed XML near line " + std::to_string(document.ErrorLineNum()));
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  const tinyxml2::XMLElement* asset = root ? root->FirstChildElement("asset") : nullptr;
  const tinyxml2::XMLElement* unit = asset ? asset->FirstChildElement("unit") : nullptr;
  const char* text = unit ? unit->Attribute("meter") : nullptr;
  if (!text) return 1;
  double meter = 0;
  if (unit->QueryDoubleAttribute("meter", &meter) != tinyxml2::XML_SUCCESS || !std::isfinite(meter) || meter <= 0) {
    throw std::runtime_error("unit meter=\"" + std::string(text) + "\" is not a positive number");
  }
  return meter;
}

}  // namespace sdf_ccd
