#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tinyxml2.h>

namespace sdf_ccd {

/// An attribute's text; empty if there is none.
std::string attributeOf(const tinyxml2::XMLElement& element, const char* name);

/// A reference `#id` to the same document. @throws std::runtime_error if there is none.
std::string referenceOf(const tinyxml2::XMLElement& element, const char* name);

/// An attribute as a non-negative integer. @param otherwise  the result if there is no such attribute.
/// @throws std::runtime_error if it is no such integer of up to 15 digits.
std::uint64_t countOf(const tinyxml2::XMLElement& element, const char* name, std::uint64_t otherwise);

/// The numbers within an element. @throws std::runtime_error, with the line, if anything else is there.
std::vector<double> numbersOf(const tinyxml2::XMLElement& element);
std::vector<std::int64_t> indicesOf(const tinyxml2::XMLElement& element);

/// An element as messages name it: `<p> near line 12`.
std::string describe(const tinyxml2::XMLElement& element);

}  // namespace sdf_ccd
