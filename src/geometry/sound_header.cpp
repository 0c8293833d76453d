#include <array>
#include <cctype>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "mended_bytes.h"
#include "whole_body.h"

namespace sdf_ccd {
namespace {

/// Every element takes a byte at the least.
void requireRoom(double count, const std::string& bytes, const std::string& line) {
  if (count >= 0 && count <= static_cast<double>(bytes.size())) return;
  throw std::runtime_error("\"" + line + "\" announces more than " + std::to_string(bytes.size()) + " bytes hold");
}

/// Where the next line begins.
std::size_t position(std::istringstream& lines, const std::string& bytes) {
  return lines.eof() ? bytes.size() : static_cast<std::size_t>(lines.tellg());
}

void readHeaderLine(const std::string& line, const std::string& bytes, std::vector<PlyElement>& elements) {
  std::istringstream words(line);
  std::string keyword, second;
  words >> keyword;
  if (keyword.empty() || keyword == "comment" || keyword == "obj_info" || keyword == "format") return;
  if (keyword == "element") {
    double count = -1;
    words >> second >> count;
    requireRoom(count, bytes, line);
    elements.push_back({second, static_cast<std::uint64_t>(count), {}});
    return;
  }
  constexpr std::array<const char*, 17> kTypes = {"char",  "uchar",  "short",   "ushort",  "int",   "uint",
                                                  "float", "double", "int8",    "uint8",   "int16", "uint16",
                                                  "int32", "uint32", "float32", "float64", "list"};
  words >> second;
  for (const char* type : kTypes) {
    if (keyword != "property" || second != type) continue;
    if (!elements.empty()) elements.back().is_list.push_back(second == "list");
    return;
  }
  throw std::runtime_error("\"" + line.substr(0, 80) + "\" in the PLY header is not known");
}

}  // namespace

void requireSoundPly(const std::string& bytes) {
  std::istringstream lines(bytes.substr(0, 1 << 16));
  std::string line;
  const auto next = [&] {
    if (!std::getline(lines, line)) throw std::runtime_error("truncated: the PLY header has no end_header");
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
  };
  next();
  if (line != "ply") throw std::runtime_error("a PLY file begins with \"ply\"");
  bool is_ascii = false;
  std::vector<PlyElement> elements;
  for (next(); line != "end_header"; next()) {
    readHeaderLine(line, bytes, elements);
    is_ascii = is_ascii || line.rfind("format ascii", 0) == 0;
  }
  if (is_ascii) requireWholeAsciiPly(bytes, position(lines, bytes), elements);
}

void requireSoundOff(const std::string& bytes) {
  std::istringstream lines(bytes.substr(0, 1 << 16));
  std::string line;
  while (std::getline(lines, line)) {
    line.erase(std::min(line.find('#'), line.size()));
    std::istringstream words(line);
    if (!std::isdigit(static_cast<unsigned char>((words >> std::ws).peek()))) {
      std::string keyword;  // OFF, with the counts on this line or the next
      if (!(words >> keyword)) continue;
    }
    double vertices, faces;
    if (!(words >> vertices)) continue;
    requireRoom(vertices, bytes, line);
    if (!(words >> faces)) faces = 0;
    requireRoom(faces, bytes, line);
    return requireWholeOff(bytes, position(lines, bytes), static_cast<std::uint64_t>(vertices),
                           static_cast<std::uint64_t>(faces));
  }
  throw std::runtime_error("truncated: the OFF header has no counts");
}

}  // namespace sdf_ccd
