#include "xml_error.h"

#include <tinyxml2.h>

namespace sdf_ccd {
namespace {

std::string reasonOf(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "it is empty";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "a tag does not match the one that it closes";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "a tag is not complete";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is not complete";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "it ends within text or an open element";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment does not end";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
    case tinyxml2::XML_ERROR_PARSING_UNKNOWN:
      return "a declaration does not end, or is at the wrong place";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested too deeply";
    default:
      return document.ErrorName();
  }
}

}  // namespace

std::string xmlError(const tinyxml2::XMLDocument& document) {
  return "line " + std::to_string(document.ErrorLineNum()) + ": " + reasonOf(document);
}

}  // namespace sdf_ccd
