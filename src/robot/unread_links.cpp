#include "unread_links.h"

#include <set>
#include <stdexcept>

#include <tinyxml2.h>

#include "common/text_limits.h"
#include "misplaced_elements.h"
#include "parse_urdf.h"
#include "readable_link.h"
#include "xml_error.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

std::size_t countChildren(const XMLElement& element, const char* name) {
  std::size_t count = 0;
  for (auto child = element.FirstChildElement(name); child; child = child->NextSiblingElement(name)) ++count;
  return count;
}

/// urdfdom's messages about this link, parsed as the only link of a robot.
std::string parserErrors(const XMLElement& link) {
  tinyxml2::XMLPrinter printer(nullptr, true);
  link.Accept(&printer);
  return urdfErrors(std::string("<robot name=\"link\">") + printer.CStr() + "</robot>");
}

}  // namespace

std::map<std::string, std::string> unreadLinks(const urdf::ModelInterface& model, const std::string& xml) {
  tinyxml2::XMLDocument document;
  const std::string text = soundText(xml);  // as the model was read from
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error("the URDF cannot be parsed: " + xmlError(document));
  }
  std::map<std::string, std::string> reasons;
  std::set<std::string> names;
  XMLElement* robot = document.FirstChildElement("robot");
  for (auto link = robot ? robot->FirstChildElement("link") : nullptr; link; link = link->NextSiblingElement("link")) {
    const std::string line = "line " + std::to_string(link->GetLineNum()) + " of the URDF: ";
    const std::string name = linkName(*link);
    const auto read = model.getLink(name);
    if (!read) continue;
    if (!names.insert(name).second) {
      reasons[name] = line + "a second link has this name";
      continue;
    }
    if (const std::string misplaced = misplacedShape(*link); !misplaced.empty()) reasons[name] = misplaced;
    makeReadable(*link);  // as in the text that the model was read from
    const std::size_t written = countChildren(*link, "collision");
    if (read->collision_array.size() == written) continue;
    reasons[name] = line + std::to_string(written - read->collision_array.size()) + " of " + std::to_string(written) +
                    " collision elements cannot be read: " + parserErrors(*link);
  }
  return reasons;
}

}  // namespace sdf_ccd
