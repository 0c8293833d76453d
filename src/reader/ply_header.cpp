#include "ply_header.h"

#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "text_words.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxHeader = std::size_t{1} << 16;  // bytes

[[noreturn]] void failUnknown(std::string_view line) {
  throw std::runtime_error("unknown line \"" + std::string(line.substr(0, 80)) + "\" in the PLY header");
}

PlyType typeOf(std::string_view word, std::string_view line) {
  using Kind = PlyType::Kind;
  static const std::unordered_map<std::string_view, PlyType> types = {
      {"char", {Kind::kSigned, 1}},     {"int8", {Kind::kSigned, 1}},     {"uchar", {Kind::kUnsigned, 1}},
      {"uint8", {Kind::kUnsigned, 1}},  {"short", {Kind::kSigned, 2}},    {"int16", {Kind::kSigned, 2}},
      {"ushort", {Kind::kUnsigned, 2}}, {"uint16", {Kind::kUnsigned, 2}}, {"int", {Kind::kSigned, 4}},
      {"int32", {Kind::kSigned, 4}},    {"uint", {Kind::kUnsigned, 4}},   {"uint32", {Kind::kUnsigned, 4}},
      {"float", {Kind::kFloat, 4}},     {"float32", {Kind::kFloat, 4}},   {"double", {Kind::kFloat, 8}},
      {"float64", {Kind::kFloat, 8}}};
  const auto found = types.find(word);
  if (found == types.end()) failUnknown(line);
  return found->second;
}

PlyHeader::Format formatOf(std::string_view word, std::string_view line) {
  if (word == "ascii") return PlyHeader::Format::kAscii;
  if (word == "binary_little_endian") return PlyHeader::Format::kLittleEndian;
  if (word == "binary_big_endian") return PlyHeader::Format::kBigEndian;
  failUnknown(line);
}

PlyProperty propertyOf(std::string_view words, std::string_view line) {
  PlyProperty property;
  std::string_view type = takeWord(words);
  if (type == "list") {
    property.is_list = true;
    property.count_type = typeOf(takeWord(words), line);
    type = takeWord(words);
  }
  property.type = typeOf(type, line);
  property.name = takeWord(words);
  return property;
}

/// Takes a line off the front, without white space at its end.
std::string_view takeHeaderLine(std::string_view& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) throw std::runtime_error("truncated: the PLY header has no end_header");
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end + 1);
  return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

}  // namespace

PlyHeader parsePlyHeader(const std::string& bytes) {
  std::string_view text = std::string_view(bytes).substr(0, kMaxHeader);
  if (takeHeaderLine(text) != "ply") throw std::runtime_error("a PLY file begins with \"ply\"");
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    const std::string_view line = takeHeaderLine(text);
    std::string_view words = line;
    const std::string_view keyword = takeWord(words);
    if (keyword == "end_header") break;
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format") {
      header.format = formatOf(takeWord(words), line);
      has_format = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.name = takeWord(words);
      element.count = requireRoom(takeNumber(words).value_or(-1.0), bytes.size(), line);
      header.elements.push_back(element);
    } else if (keyword == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(propertyOf(words, line));
    } else {
      failUnknown(line);
    }
  }
  if (!has_format) throw std::runtime_error("the PLY header names no format");
  header.end = static_cast<std::size_t>(text.data() - bytes.data());
  return header;
}

}  // namespace sdf_ccd
