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

bool startsAsText(const std::string& bytes) {
  const auto start =
      std::find_if(bytes.begin(), bytes.end(), [](char c) { return !std::isspace(static_cast<unsigned char>(c)); });
  const std::string word = bytes.substr(static_cast<std::size_t>(start - bytes.begin()), 5);
  return word == "solid" || word == "SOLID" || word == "Solid";
}

/// True if the file begins with `solid`, holds a facet and has no zero byte in its first 4 KiB. Binary files have zero
/// bytes in their attributes, their count and most coordinates.
bool isText(const std::string& bytes) {
  const std::string head = bytes.substr(0, 4096);
  return startsAsText(head) && head.find('\0') == std::string::npos &&
         (bytes.find("facet") != std::string::npos || bytes.find("FACET") != std::string::npos);
}

/// Whether it begins with text, such as a web page or the pointer to a large file that git has not fetched.
bool isPrintable(const std::string& bytes) {
  constexpr std::size_t kHead = 100;
  return !bytes.empty() &&
         std::all_of(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(kHead, bytes.size())),
                     [](unsigned char c) { return std::isprint(c) || std::isspace(c); });
}

std::uint64_t announcedTriangles(const std::string& bytes) {
  std::uint64_t count = 0;
  for (int i = 3; i >= 0; --i) count = count << 8 | static_cast<unsigned char>(bytes[80 + i]);
  return count;
}

bool isWord(std::string_view word, const char* lower_case) {
  return std::equal(word.begin(), word.end(), lower_case, lower_case + std::strlen(lower_case),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

TriangleMesh parseText(const std::string& bytes) {
  TriangleMesh mesh;
  PolygonList faces;
  std::vector<std::int64_t> corners;
  bool is_whole = false;
  std::string_view text = bytes;
  // The name of a solid may hold any words, so the rest of its line is skipped.
  for (std::string_view word = takeWord(text); !word.empty(); word = takeWord(text)) {
    const bool begins = isWord(word, "solid"), ends = isWord(word, "endsolid");
    if (begins || ends) text.remove_prefix(std::min(text.find('\n'), text.size()));
    if (begins || ends) is_whole = ends;
    if ((ends || isWord(word, "facet")) && !corners.empty()) throw std::runtime_error("damaged: a facet without end");
    if (isWord(word, "vertex")) {
      double p[3];
      for (double& coordinate : p) {
        const std::optional<double> number = takeNumber(text);
        if (!number) throw std::runtime_error("truncated or damaged: a vertex without three coordinates");
        coordinate = *number;
      }
      corners.push_back(static_cast<std::int64_t>(mesh.vertices.size()));
      mesh.vertices.emplace_back(p[0], p[1], p[2]);
    }
    if (!isWord(word, "endfacet")) continue;
    if (corners.size() < 3)
      throw std::runtime_error("damaged: a facet of " + std::to_string(corners.size()) + " vertices");
    faces.add(corners);
    corners.clear();
  }
  if (!is_whole) throw std::runtime_error("truncated: no endsolid at its end");
  faces.appendTo(mesh);
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
  if (bytes.size() != length && isPrintable(bytes)) {
    if (startsAsText(bytes)) throw std::runtime_error("an ASCII STL without a facet");
    throw std::runtime_error("it is text, but no STL; it begins with \"" +
                             bytes.substr(0, bytes.find_first_of("\r\n")).substr(0, 60) + "\"");
  }
  if (bytes.size() < kHeader) {
    throw std::runtime_error("truncated: " + std::to_string(bytes.size()) + " bytes are neither ASCII nor binary STL");
  }
  if (bytes.size() < length) {
    throw std::runtime_error("truncated: " + std::to_string(triangles) + " triangles need " + std::to_string(length) +
                             " bytes, there are " + std::to_string(bytes.size()));
  }
  return parseBinary(bytes, triangles);
}

}  // namespace sdf_ccd
