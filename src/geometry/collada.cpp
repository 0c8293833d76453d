#include "collada.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include <tinyxml2.h>

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

/// The next element in document order, below `root`.
const XMLElement* next(const XMLElement* element, const XMLElement* root) {
  if (const XMLElement* child = element->FirstChildElement()) return child;
  while (element != root) {
    if (const XMLElement* sibling = element->NextSiblingElement()) return sibling;
    element = element->Parent()->ToElement();
  }
  return nullptr;
}

void requireIntegers(const XMLElement& element) {
  const char* text = element.GetText();
  if (!text) return;
  const std::size_t good = std::strspn(text, "0123456789- \t\r\n");
  if (text[good] == '\0') return;
  throw std::runtime_error("<" + std::string(element.Name()) + "> near line " + std::to_string(element.GetLineNum()) +
                           " holds \"" + std::string(text + good, strnlen(text + good, 20)) + "\" among its numbers");
}

std::string attribute(const XMLElement& element, const char* name) {
  const char* text = element.Attribute(name);
  return text ? text : "";
}

/// An accessor must stay within its array, whose length assimp takes from the attribute `count`.
void requireInBounds(const XMLElement& accessor, const std::map<std::string, double>& lengths) {
  const std::string source = attribute(accessor, "source");
  const auto array = lengths.find(source.empty() ? source : source.substr(1));
  if (array == lengths.end()) return;  // assimp says so itself
  double parameters = 0;
  for (const XMLElement* p = accessor.FirstChildElement("param"); p; p = p->NextSiblingElement("param")) ++parameters;
  const double stride = std::max(1.0, accessor.DoubleAttribute("stride", 1));
  const double end = accessor.DoubleAttribute("offset") + stride * accessor.DoubleAttribute("count");
  if (end <= array->second && parameters <= stride) return;
  throw std::runtime_error("<accessor> near line " + std::to_string(accessor.GetLineNum()) + " reads beyond the " +
                           std::to_string(static_cast<long long>(array->second)) + " numbers of \"" + source + "\"");
}

/// Which nodes each node instances, by id.
using Instances = std::map<std::string, std::vector<std::string>>;

void requireAcyclic(const std::string& node, const Instances& instances, std::set<std::string>& open,
                    std::set<std::string>& done) {
  if (done.count(node)) return;
  if (!open.insert(node).second) throw std::runtime_error("the node \"" + node + "\" contains itself");
  if (open.size() > 1000) throw std::runtime_error("nodes are instanced more than 1000 deep");
  const auto found = instances.find(node);
  if (found != instances.end()) {
    for (const std::string& child : found->second) requireAcyclic(child, instances, open, done);
  }
  open.erase(node);
  done.insert(node);
}

void inspectElements(const XMLElement& root) {
  Instances instances;
  std::map<std::string, double> lengths;
  for (const XMLElement* element = &root; element; element = next(element, &root)) {
    const std::string name = element->Name();
    if (name == "float_array") lengths[attribute(*element, "id")] = element->DoubleAttribute("count");
  }
  for (const XMLElement* element = &root; element; element = next(element, &root)) {
    const std::string name = element->Name();
    if (name == "accessor") requireInBounds(*element, lengths);
    if (name == "p" || name == "vcount" || name == "h") requireIntegers(*element);
    if (name != "instance_node") continue;
    const std::string url = attribute(*element, "url");
    if (url.empty() || url[0] != '#') continue;
    // A node holds what the nodes inside it instance.
    for (const tinyxml2::XMLNode* parent = element->Parent(); parent; parent = parent->Parent()) {
      const std::string id = parent->ToElement() ? attribute(*parent->ToElement(), "id") : "";
      if (!id.empty()) instances[id].push_back(url.substr(1));
    }
  }
  std::set<std::string> open, done;
  for (const auto& [node, children] : instances) requireAcyclic(node, instances, open, done);
}

}  // namespace

double inspectCollada(const std::string& xml) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error("not well-formed XML near line " + std::to_string(document.ErrorLineNum()));
  }
  const XMLElement* root = document.RootElement();
  if (!root) throw std::runtime_error("an XML document without elements");
  inspectElements(*root);
  const XMLElement* asset = root->FirstChildElement("asset");
  const XMLElement* unit = asset ? asset->FirstChildElement("unit") : nullptr;
  const char* text = unit ? unit->Attribute("meter") : nullptr;
  if (!text) return 1;
  double meter = 0;
  if (unit->QueryDoubleAttribute("meter", &meter) != tinyxml2::XML_SUCCESS || !std::isfinite(meter) || meter <= 0) {
    throw std::runtime_error("unit meter=\"" + std::string(text) + "\" is not a positive number");
  }
  return meter;
}

}  // namespace sdf_ccd
