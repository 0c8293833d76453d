#include "mesh_formats.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "polygon_mesh.h"
#include "text_words.h"

namespace sdf_ccd {
namespace {

/// Of numbers in a binary file.
struct Type {
  std::size_t bytes;
  double (*value)(const char* bytes);
};

template <class T>
constexpr Type typeOf = {sizeof(T), [](const char* bytes) {
                           T value;
                           std::memcpy(&value, bytes, sizeof value);
                           return static_cast<double>(value);
                         }};

struct Property {
  std::string_view name;
  const Type* type;
  const Type* count;  ///< of the numbers of a list; null if it is no list
};

struct Element {
  std::string_view name;
  std::uint64_t count;
  std::vector<Property> properties;
};

struct Header {
  std::string_view format;
  std::vector<Element> elements;
};

[[noreturn]] void failUnknown(std::string_view line) {
  throw std::runtime_error("unknown line \"" + std::string(line.substr(0, 80)) + "\" in the PLY header");
}

const Type* takeType(std::string_view& words, std::string_view line) {
  static const std::map<std::string_view, Type> types = {
      {"char", typeOf<std::int8_t>},     {"int8", typeOf<std::int8_t>},     {"uchar", typeOf<std::uint8_t>},
      {"uint8", typeOf<std::uint8_t>},   {"short", typeOf<std::int16_t>},   {"int16", typeOf<std::int16_t>},
      {"ushort", typeOf<std::uint16_t>}, {"uint16", typeOf<std::uint16_t>}, {"int", typeOf<std::int32_t>},
      {"int32", typeOf<std::int32_t>},   {"uint", typeOf<std::uint32_t>},   {"uint32", typeOf<std::uint32_t>},
      {"float", typeOf<float>},          {"float32", typeOf<float>},        {"double", typeOf<double>},
      {"float64", typeOf<double>}};
  const auto found = types.find(takeWord(words));
  if (found == types.end()) failUnknown(line);
  return &found->second;
}

Property takeProperty(std::string_view& words, std::string_view line) {
  Property property = {};
  if (std::string_view rest = words; takeWord(rest) == "list") {
    words = rest;
    property.count = takeType(words, line);
  }
  property.type = takeType(words, line);
  property.name = takeWord(words);
  return property;
}

/// Takes the header off the front of the file.
Header takeHeader(std::string_view& file) {
  const std::size_t bytes = file.size();
  Header header;
  if (std::string_view words = file; takeWord(words) != "ply") throw std::runtime_error("it does not begin with ply");
  for (std::string_view keyword; keyword != "end_header";) {
    const std::size_t end = file.find('\n');
    if (end == std::string_view::npos) throw std::runtime_error("truncated: the PLY header has no end_header");
    const std::string_view line = file.substr(0, end);
    file.remove_prefix(end + 1);
    std::string_view words = line;
    keyword = takeWord(words);
    if (keyword == "format") {
      header.format = takeWord(words);
    } else if (keyword == "element") {
      const std::string_view name = takeWord(words);
      header.elements.push_back({name, requireRoom(takeNumber(words).value_or(-1.0), bytes, line), {}});
    } else if (keyword == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(takeProperty(words, line));
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info" && keyword != "ply" &&
               keyword != "end_header") {
      failUnknown(line);
    }
  }
  return header;
}

/// Takes the numbers of a file's body one after the other.
class Numbers {
 public:
  Numbers(std::string_view body, std::string_view format)
      : rest_(body), is_text_(format == "ascii"), is_big_endian_(format == "binary_big_endian") {
    if (!is_text_ && !is_big_endian_ && format != "binary_little_endian") {
      throw std::runtime_error("the PLY header names no known format");
    }
  }

  /// The next number; none at the end of the file, or if the next word is no number.
  std::optional<double> take(const Type& type) {
    if (is_text_) return takeNumber(rest_);
    if (rest_.size() < type.bytes) return std::nullopt;
    char bytes[8];
    std::copy_n(rest_.data(), type.bytes, bytes);
    if (is_big_endian_) std::reverse(bytes, bytes + type.bytes);
    rest_.remove_prefix(type.bytes);
    return type.value(bytes);
  }

  std::size_t bytesLeft() const { return rest_.size(); }

 private:
  std::string_view rest_;
  bool is_text_, is_big_endian_;
};

/// Takes one instance of an element: its coordinates and its corners, if it has any.
/// @return false if it is damaged, or the file ends within it.
bool takeInstance(const Element& element, Numbers& numbers, Vector3d& point, std::vector<std::int64_t>& corners) {
  corners.clear();
  for (const Property& property : element.properties) {
    const double count = property.count ? numbers.take(*property.count).value_or(-1.0) : 1.0;
    if (!(count >= 0.0 && count <= static_cast<double>(numbers.bytesLeft()) && count == std::floor(count)))
      return false;
    const bool are_corners = property.name == "vertex_indices" || property.name == "vertex_index";
    for (auto left = static_cast<std::size_t>(count); left > 0; --left) {
      const std::optional<double> number = numbers.take(*property.type);
      if (!number) return false;
      if (property.count && are_corners) {
        if (!(*number >= -1.0 && *number <= 0x1p32 && *number == std::floor(*number))) return false;
        corners.push_back(static_cast<std::int64_t>(*number));
      }
      if (!property.count && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
        point[property.name[0] - 'x'] = *number;
      }
    }
  }
  return true;
}

/// Throws if a vertex lacks a coordinate: it is unknown, not 0.
void requireCoordinates(const Element& vertex) {
  for (const char* name : {"x", "y", "z"}) {
    const bool is_there = std::any_of(vertex.properties.begin(), vertex.properties.end(),
                                      [&](const Property& p) { return !p.count && p.name == name; });
    if (!is_there) throw std::runtime_error(std::string("the PLY header gives vertices no property ") + name);
  }
}

/// Appends a triangle for every corner after the second of a strip, with alternating orientation; -1 ends a strip.
void appendStrips(const std::vector<std::int64_t>& strips, std::vector<std::vector<std::int64_t>>& faces) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (strips[i] < 0) begin = i + 1;
    if (i < begin + 2) continue;
    const bool odd = (i - begin) % 2 != 0;
    faces.push_back({strips[odd ? i - 1 : i - 2], strips[odd ? i - 2 : i - 1], strips[i]});
  }
}

}  // namespace

TriangleMesh parsePly(const std::string& bytes) {
  std::string_view body = bytes;
  const Header header = takeHeader(body);
  Numbers numbers(body, header.format);
  TriangleMesh mesh;
  std::vector<std::vector<std::int64_t>> faces;  // of vertices that may come later
  std::vector<std::int64_t> corners;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") requireCoordinates(element);
    if (element.properties.empty()) continue;
    Vector3d point = Vector3d::Zero();
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!takeInstance(element, numbers, point, corners)) failTruncated(element.name, element.count, i);
      if (element.name == "vertex") mesh.vertices.push_back(point);
      if (element.name == "face") faces.push_back(corners);
      if (element.name == "tristrips") appendStrips(corners, faces);
    }
  }
  for (const std::vector<std::int64_t>& face : faces) appendPolygon(face, mesh);
  return mesh;
}

}  // namespace sdf_ccd
