#include "xml_numbers.h"

#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "common/read_number.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

constexpr const char* kSpace = " \t\r\n\v\f";
constexpr std::size_t kShown = 20;  // characters shown of an invalid number, upper bound

/// Calls take(text, end) for each word of the element's text; take() parses a number and sets `end` behind it.
/// @throws std::runtime_error if a word is not wholly a number.
template <class Take>
void forEachWord(const XMLElement& element, const Take& take) {
  for (const tinyxml2::XMLNode* node = element.FirstChild(); node; node = node->NextSibling()) {
    if (!node->ToText()) continue;
    const char* text = node->Value();
    for (text += std::strspn(text, kSpace); *text; text += std::strspn(text, kSpace)) {
      char* end = nullptr;
      take(text, &end);
      if (end == text || (*end && !std::strchr(kSpace, *end))) {
        throw std::runtime_error(describe(element) + " holds \"" + std::string(text, strnlen(text, kShown)) +
                                 "\" among its numbers");
      }
      text = end;
    }
  }
}

}  // namespace

std::string attributeOf(const XMLElement& element, const char* name) {
  const char* text = element.Attribute(name);
  return text ? text : "";
}

std::string referenceOf(const XMLElement& element, const char* name) {
  const std::string reference = attributeOf(element, name);
  if (reference.size() > 1 && reference[0] == '#') return reference.substr(1);
  throw std::runtime_error(describe(element) + " refers to \"" + reference.substr(0, 80) +
                           "\", not within the document");
}

std::uint64_t countOf(const XMLElement& element, const char* name, std::uint64_t otherwise) {
  const std::string text = attributeOf(element, name);
  if (text.empty()) return otherwise;
  if (text.find_first_not_of("0123456789") == std::string::npos && text.size() < 16) return std::stoull(text);
  throw std::runtime_error(describe(element) + ": " + name + "=\"" + text.substr(0, 80) +
                           "\" is not a non-negative integer");
}

std::vector<double> numbersOf(const XMLElement& element) {
  std::vector<double> numbers;
  forEachWord(element, [&](const char* text, char** end) { numbers.push_back(readNumber(text, end)); });
  return numbers;
}

std::vector<std::int64_t> indicesOf(const XMLElement& element) {
  std::vector<std::int64_t> indices;
  forEachWord(element, [&](const char* text, char** end) { indices.push_back(std::strtoll(text, end, 10)); });
  return indices;
}

std::string describe(const XMLElement& element) {
  return "<" + std::string(element.Name()) + "> near line " + std::to_string(element.GetLineNum());
}

}  // namespace sdf_ccd
