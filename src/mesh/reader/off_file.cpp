#include "mesh_formats.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "polygon_mesh.h"
#include "text_words.h"

namespace sdf_ccd {
namespace {

struct Counts {
  std::uint64_t vertices = 0, faces = 0;
};

/// Takes the keyword `OFF`, which may be missing, and the counts on the same line or the next.
Counts takeHeader(std::string_view& text, std::size_t bytes) {
  std::string_view line = takeLine(text), rest = line, keyword = takeWord(rest);
  if (keyword.empty() || std::isdigit(static_cast<unsigned char>(keyword.front())) == 0) {
    for (const std::string_view prefix : {"ST", "C", "N"}) {
      if (keyword.substr(0, prefix.size()) == prefix) keyword.remove_prefix(prefix.size());
    }
    std::string_view words = rest;
    const std::string_view second = takeWord(words);
    if (keyword != "OFF" || second == "BINARY") {
      throw std::runtime_error("it does not begin with OFF, as text with vertices of three coordinates does");
    }
    if (second.empty()) line = rest = takeLine(text);
  } else {
    rest = line;
  }
  Counts counts;
  const std::optional<double> vertices = takeNumber(rest);
  if (!vertices) throw std::runtime_error("truncated: the OFF header has no counts");
  counts.vertices = requireRoom(*vertices, bytes, line);
  const std::optional<double> faces = takeNumber(rest);
  if (faces) counts.faces = requireRoom(*faces, bytes, line);
  return counts;
}

/// Takes a whole number up to `highest` off the front; -1 if there is none.
std::int64_t takeIndex(std::string_view& line, double highest) {
  const double number = takeNumber(line).value_or(-1.0);
  return number >= 0.0 && number <= highest && number == std::floor(number) ? static_cast<std::int64_t>(number) : -1;
}

/// Parses the number of corners and the index of each; a colour may follow on the line. @return false if it is invalid.
bool takeFace(std::string_view line, std::vector<std::int64_t>& corners) {
  corners.clear();
  const std::int64_t count = takeIndex(line, static_cast<double>(line.size()));
  for (std::int64_t i = 0; i < count; ++i) corners.push_back(takeIndex(line, 0x1p32));
  return count >= 0 && (corners.empty() || *std::min_element(corners.begin(), corners.end()) >= 0);
}

}  // namespace

TriangleMesh parseOff(const std::string& bytes) {
  std::string_view text = bytes;
  const Counts counts = takeHeader(text, bytes.size());
  TriangleMesh mesh;
  for (std::uint64_t i = 0; i < counts.vertices; ++i) {
    std::string_view line = takeLine(text);
    Vector3d p;
    for (double& coordinate : p) {
      const std::optional<double> number = takeNumber(line);
      if (!number) failTruncated("vertex", counts.vertices, i);
      coordinate = *number;
    }
    mesh.vertices.push_back(p);
  }
  std::vector<std::int64_t> corners;
  for (std::uint64_t i = 0; i < counts.faces; ++i) {
    if (!takeFace(takeLine(text), corners)) failTruncated("face", counts.faces, i);
    appendPolygon(corners, mesh);
  }
  return mesh;
}

}  // namespace sdf_ccd
