#include "mesh_formats.h"

#include <stdexcept>

#include "polygon_mesh.h"
#include "text_words.h"

namespace sdf_ccd {
namespace {

constexpr std::uint64_t kMaxIndex = std::uint64_t{1} << 32;

struct Counts {
  std::uint64_t vertices = 0, faces = 0;
};

/// Removes the prefix if the keyword begins with it.
void takePrefix(std::string_view& keyword, std::string_view prefix) {
  if (keyword.substr(0, prefix.size()) == prefix) keyword.remove_prefix(prefix.size());
}

void requirePlainOff(std::string_view keyword, std::string_view rest) {
  for (const char* prefix : {"ST", "C", "N"}) takePrefix(keyword, prefix);
  if (keyword == "4OFF" || keyword == "nOFF" || keyword == "4nOFF") {
    throw std::runtime_error("OFF whose vertices have other than three coordinates is not read");
  }
  if (keyword != "OFF") throw std::runtime_error("an OFF file begins with \"OFF\" or its counts");
  if (takeWord(rest) == "BINARY") throw std::runtime_error("binary OFF is not read");
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// Takes the keyword `OFF`, which may be missing, and the counts on the same line or the next.
Counts takeHeader(std::string_view& text, std::size_t bytes) {
  std::string_view line = takeLine(text);
  std::string_view rest = line;
  const std::string_view keyword = takeWord(rest);
  if (keyword.empty()) throw std::runtime_error("truncated: the OFF header has no counts");
  if (isDigit(keyword.front())) {
    rest = line;
  } else {
    requirePlainOff(keyword, rest);
    std::string_view words = rest;
    if (takeWord(words).empty()) line = rest = takeLine(text);
  }
  Counts counts;
  const std::optional<double> vertices = takeNumber(rest);
  if (!vertices) throw std::runtime_error("truncated: the OFF header has no counts");
  counts.vertices = requireRoom(*vertices, bytes, line);
  const std::optional<double> faces = takeNumber(rest);
  if (faces) counts.faces = requireRoom(*faces, bytes, line);
  return counts;
}

Vector3d takeVertex(std::string_view line, const Counts& counts, std::uint64_t index) {
  Vector3d p;
  for (double& coordinate : p) {
    const std::optional<double> number = takeNumber(line);
    if (!number) failTruncated("vertex", counts.vertices, index);
    coordinate = *number;
  }
  return p;
}

/// Parses the number of corners and the index of each; a colour may follow on the line. @return false if it is invalid.
bool takeFace(std::string_view line, std::vector<std::int64_t>& corners) {
  corners.clear();
  const std::optional<std::uint64_t> count = takeCount(line);
  if (!count || *count > line.size()) return false;
  for (std::uint64_t i = 0; i < *count; ++i) {
    const std::optional<std::uint64_t> corner = takeCount(line);
    if (!corner || *corner > kMaxIndex) return false;
    corners.push_back(static_cast<std::int64_t>(*corner));
  }
  return true;
}

}  // namespace

TriangleMesh parseOff(const std::string& bytes) {
  std::string_view text = bytes;
  const Counts counts = takeHeader(text, bytes.size());
  TriangleMesh mesh;
  for (std::uint64_t i = 0; i < counts.vertices; ++i) mesh.vertices.push_back(takeVertex(takeLine(text), counts, i));
  std::vector<std::int64_t> corners;
  PolygonList faces;
  for (std::uint64_t i = 0; i < counts.faces; ++i) {
    if (!takeFace(takeLine(text), corners)) failTruncated("face", counts.faces, i);
    faces.add(corners);
  }
  faces.appendTo(mesh);
  return mesh;
}

}  // namespace sdf_ccd
