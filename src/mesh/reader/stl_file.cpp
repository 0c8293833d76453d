#include "mesh_formats.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "polygon_mesh.h"
#include "text_words.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50;

/// The count of a binary file, its attributes and most of its coordinates have zero bytes. Its header may be any text.
bool isText(const std::string& bytes) {
  return !bytes.empty() && bytes.substr(0, 4096).find('\0') == std::string::npos;
}

std::uint64_t announcedTriangles(const std::string& bytes) {
  std::uint64_t count = 0;
  for (int i = 3; i >= 0; --i) count = count << 8 | static_cast<unsigned char>(bytes[80 + i]);
  return count;
}

TriangleMesh parseText(std::string bytes) {
  std::transform(bytes.begin(), bytes.end(), bytes.begin(), [](unsigned char c) { return std::tolower(c); });
  std::string_view text = bytes;
  if (std::string_view words = text; takeWord(words) != "solid") {
    throw std::runtime_error("it is text, but no STL; it begins with \"" +
                             bytes.substr(0, std::min<std::size_t>(bytes.find_first_of("\r\n"), 60)) + "\"");
  }
  TriangleMesh mesh;
  std::vector<std::int64_t> corners;
  bool is_whole = false;
  // The name of a solid may hold any words, so the rest of its line is skipped.
  for (std::string_view word = takeWord(text); !word.empty(); word = takeWord(text)) {
    const bool begins = word == "solid", ends = word == "endsolid";
    if (begins || ends) text.remove_prefix(std::min(text.find('\n'), text.size()));
    if (begins || ends) is_whole = ends;
    if ((ends || word == "facet") && !corners.empty()) throw std::runtime_error("damaged: a facet without end");
    if (word == "vertex") {
      double p[3];
      for (double& coordinate : p) {
        const std::optional<double> number = takeNumber(text);
        if (!number) throw std::runtime_error("truncated or damaged: a vertex without three coordinates");
        coordinate = *number;
      }
      corners.push_back(static_cast<std::int64_t>(mesh.vertices.size()));
      mesh.vertices.emplace_back(p[0], p[1], p[2]);
    }
    if (word != "endfacet") continue;
    if (corners.size() < 3)
      throw std::runtime_error("damaged: a facet of " + std::to_string(corners.size()) + " vertices");
    appendPolygon(corners, mesh);
    corners.clear();
  }
  if (!is_whole) throw std::runtime_error("truncated: no endsolid at its end");
  return mesh;
}

TriangleMesh parseBinary(const std::string& bytes, std::uint64_t triangles) {
  TriangleMesh mesh;
  for (std::uint64_t i = 0; i < triangles; ++i) {
    constexpr std::size_t kNormal = 12;
    float p[9];
    std::memcpy(p, bytes.data() + kHeader + kTriangle * i + kNormal, sizeof p);
    const int first = static_cast<int>(mesh.vertices.size());
    for (int corner = 0; corner < 3; ++corner) {
      mesh.vertices.emplace_back(p[3 * corner], p[3 * corner + 1], p[3 * corner + 2]);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

}  // namespace

TriangleMesh parseStl(const std::string& bytes) {
  const std::uint64_t triangles = bytes.size() >= kHeader ? announcedTriangles(bytes) : 0;
  const std::uint64_t length = kHeader + kTriangle * triangles;
  if (bytes.size() != length && isText(bytes)) return parseText(bytes);
  if (bytes.size() < length) {
    throw std::runtime_error("truncated: " + std::to_string(triangles) + " triangles need " + std::to_string(length) +
                             " bytes, there are " + std::to_string(bytes.size()));
  }
  return parseBinary(bytes, triangles);
}

}  // namespace sdf_ccd
