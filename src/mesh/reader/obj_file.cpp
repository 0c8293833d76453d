#include "mesh_formats.h"

#include <charconv>
#include <stdexcept>

#include "polygon_mesh.h"
#include "text_words.h"

namespace sdf_ccd {
namespace {

[[noreturn]] void fail(std::size_t line, const std::string& what) {
  throw std::runtime_error("line " + std::to_string(line) + ": " + what);
}

/// Parses the coordinates of a `v` line, which a weight or a colour may follow.
Vector3d vertexOn(std::string_view words, std::size_t line) {
  std::vector<double> numbers;
  while (const std::optional<double> number = takeNumber(words)) numbers.push_back(*number);
  if (numbers.size() < 3) fail(line, "a vertex of " + std::to_string(numbers.size()) + " coordinates");
  const double weight = numbers.size() == 4 && numbers[3] != 0.0 ? numbers[3] : 1.0;
  return {numbers[0] / weight, numbers[1] / weight, numbers[2] / weight};
}

/// Index from 0 of the vertex in `v`, `v/vt`, `v//vn` or `v/vt/vn`. The file counts from 1, or backwards from the
/// latest vertex with -1.
std::int64_t cornerOf(std::string_view word, std::size_t vertices, std::size_t line) {
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  const bool is_whole = error == std::errc() && (end == word.data() + word.size() || *end == '/');
  if (!is_whole || index == 0) fail(line, "a face with an invalid vertex index");
  return index > 0 ? index - 1 : static_cast<std::int64_t>(vertices) + index;
}

/// Takes a line off the front, without its comment. A backslash at the end of a line continues it on the next.
std::string takeLogicalLine(std::string_view& text, std::size_t& line) {
  std::string whole;
  for (;;) {
    const std::size_t end = text.find('\n');
    std::string_view part = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++line;
    if (!part.empty() && part.back() == '\r') part.remove_suffix(1);
    part = part.substr(0, part.find('#'));
    const bool goes_on = !part.empty() && part.back() == '\\' && !text.empty();
    if (goes_on) part.remove_suffix(1);
    whole += part;
    if (!goes_on) return whole;
    whole += ' ';
  }
}

}  // namespace

TriangleMesh parseObj(const std::string& bytes) {
  std::string_view text = bytes;
  TriangleMesh mesh;
  std::vector<std::vector<std::int64_t>> faces;  // of vertices that may come later
  for (std::size_t line = 0; !text.empty();) {
    const std::string whole = takeLogicalLine(text, line);
    std::string_view words = whole;
    const std::string_view keyword = takeWord(words);
    if (keyword == "v") mesh.vertices.push_back(vertexOn(words, line));
    if (keyword != "f") continue;
    std::vector<std::int64_t>& corners = faces.emplace_back();
    for (std::string_view word = takeWord(words); !word.empty(); word = takeWord(words)) {
      corners.push_back(cornerOf(word, mesh.vertices.size(), line));
    }
    if (corners.size() < 3) fail(line, "a face of " + std::to_string(corners.size()) + " corners");
  }
  for (const std::vector<std::int64_t>& corners : faces) appendPolygon(corners, mesh);
  return mesh;
}

}  // namespace sdf_ccd
