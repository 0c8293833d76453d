#include "mesh_formats.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "ply_header.h"
#include "polygon_mesh.h"
#include "text_words.h"

namespace sdf_ccd {
namespace {

template <class T>
double valueOf(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double valueOf(const PlyType& type, const unsigned char* bytes) {
  const bool is_signed = type.kind == PlyType::Kind::kSigned;
  if (type.kind == PlyType::Kind::kFloat) return type.bytes == 4 ? valueOf<float>(bytes) : valueOf<double>(bytes);
  switch (type.bytes) {
    case 1:
      return is_signed ? valueOf<std::int8_t>(bytes) : valueOf<std::uint8_t>(bytes);
    case 2:
      return is_signed ? valueOf<std::int16_t>(bytes) : valueOf<std::uint16_t>(bytes);
    default:
      return is_signed ? valueOf<std::int32_t>(bytes) : valueOf<std::uint32_t>(bytes);
  }
}

/// Reads the numbers of a file's body one after the other.
class PlyNumbers {
 public:
  PlyNumbers(const std::string& bytes, const PlyHeader& header)
      : rest_(std::string_view(bytes).substr(header.end)), format_(header.format) {}

  /// The next number; none at the end of the file, or if the next word is no number.
  std::optional<double> take(const PlyType& type) {
    if (format_ == PlyHeader::Format::kAscii) return takeNumber(rest_);
    if (rest_.size() < type.bytes) return std::nullopt;
    unsigned char bytes[8];
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t to = format_ == PlyHeader::Format::kBigEndian ? type.bytes - 1 - i : i;
      bytes[to] = static_cast<unsigned char>(rest_[i]);
    }
    rest_.remove_prefix(type.bytes);
    return valueOf(type, bytes);
  }

  std::size_t bytesLeft() const { return rest_.size(); }

 private:
  std::string_view rest_;
  PlyHeader::Format format_;
};

/// Reads the properties of one element: coordinates into `point`, the list of vertex indices into `corners`.
class ElementReader {
 public:
  ElementReader(const PlyElement& element, PlyNumbers& numbers) : element_(element), numbers_(numbers) {}

  Vector3d point = Vector3d::Zero();
  std::vector<std::int64_t> corners;

  /// Reads the next instance. @return false if the file ends within it or it is damaged.
  bool read() {
    corners.clear();
    for (const PlyProperty& property : element_.properties) {
      if (!(property.is_list ? readList(property) : readNumber(property))) return false;
    }
    return true;
  }

 private:
  bool readNumber(const PlyProperty& property) {
    const std::optional<double> number = numbers_.take(property.type);
    if (!number) return false;
    if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
      point[property.name[0] - 'x'] = *number;
    }
    return true;
  }

  bool readList(const PlyProperty& property) {
    const double count = numbers_.take(property.count_type).value_or(-1.0);
    if (!(count >= 0.0 && count <= static_cast<double>(numbers_.bytesLeft()))) return false;
    const bool is_wanted = property.name == "vertex_indices" || property.name == "vertex_index";
    for (double i = 0.0; i < count; ++i) {
      const std::optional<double> number = numbers_.take(property.type);
      if (!number || !(*number >= -1.0 && *number <= 4294967295.0)) {
        if (!number || is_wanted) return false;
        continue;
      }
      if (is_wanted) corners.push_back(static_cast<std::int64_t>(*number));
    }
    return true;
  }

  const PlyElement& element_;
  PlyNumbers& numbers_;
};

/// Throws if a vertex lacks a coordinate: it is unknown, not 0.
void requireCoordinates(const PlyElement& vertex) {
  for (const char* name : {"x", "y", "z"}) {
    const bool is_there = std::any_of(vertex.properties.begin(), vertex.properties.end(),
                                      [&](const PlyProperty& p) { return !p.is_list && p.name == name; });
    if (!is_there) throw std::runtime_error(std::string("the PLY header gives vertices no property ") + name);
  }
}

/// Adds a triangle for every corner after the second of a strip, with alternating orientation; -1 ends a strip.
void addStrips(const std::vector<std::int64_t>& strips, PolygonList& faces) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (strips[i] < 0) begin = i + 1;
    if (i < begin + 2) continue;
    const bool odd = (i - begin) % 2 != 0;
    faces.add({strips[odd ? i - 1 : i - 2], strips[odd ? i - 2 : i - 1], strips[i]});
  }
}

}  // namespace

TriangleMesh parsePly(const std::string& bytes) {
  const PlyHeader header = parsePlyHeader(bytes);
  PlyNumbers numbers(bytes, header);
  TriangleMesh mesh;
  PolygonList faces;
  for (const PlyElement& element : header.elements) {
    ElementReader reader(element, numbers);
    if (element.name == "vertex") requireCoordinates(element);
    if (element.properties.empty()) continue;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!reader.read()) failTruncated(element.name, element.count, i);
      if (element.name == "vertex") {
        mesh.vertices.push_back(reader.point);
      } else if (element.name == "face") {
        faces.add(reader.corners);
      } else if (element.name == "tristrips") {
        addStrips(reader.corners, faces);
      }
    }
  }
  faces.appendTo(mesh);
  return mesh;
}

}  // namespace sdf_ccd
