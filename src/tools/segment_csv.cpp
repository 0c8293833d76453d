#include "segment_csv.h"

#include <cctype>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "common/files/regular_file.h"
#include "common/read_number.h"

namespace sdf_ccd::tools {
namespace {

constexpr std::size_t kColumns = 6;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  if (!line.empty() && line.back() == ',') words.emplace_back();
  return words;
}

/// True only for the exact names of the columns: any other line without numbers means another format of data.
bool isHeader(const std::string& line) {
  std::string names;
  for (const unsigned char c : line) {
    if (!std::isspace(c)) names += static_cast<char>(std::tolower(c));
  }
  return names == "ox,oy,oz,ex,ey,ez";
}

Segment parseSegment(const std::vector<std::string>& words) {
  if (words.size() != kColumns) {
    throw std::runtime_error("expected six numbers ox,oy,oz,ex,ey,ez, got " + std::to_string(words.size()));
  }
  double values[kColumns];
  for (std::size_t i = 0; i < kColumns; ++i) {
    const std::optional<double> value = wholeNumber(words[i]);
    if (!value) throw std::runtime_error("\"" + words[i] + "\" is not a number");
    if (!std::isfinite(*value)) throw std::runtime_error("\"" + words[i] + "\" is not finite");
    values[i] = *value;
  }
  const Segment segment{Vector3d(values), Vector3d(values + 3)};
  if (!isWithinReach(segment)) throw std::runtime_error("the segment reaches farther than 1e12 m");
  return segment;
}

}  // namespace

std::vector<Segment> readSegments(const std::string& path) {
  std::istringstream stream(readNamedFile(path));
  std::vector<Segment> segments;
  std::size_t line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";  // spreadsheets write it first
    if (line_number == 1 && line.rfind(kByteOrderMark, 0) == 0) line.erase(0, 3);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.find_first_not_of(" \t") == std::string::npos) continue;
    if (line_number == 1 && isHeader(line)) continue;
    try {
      segments.push_back(parseSegment(split(line)));
    } catch (const std::exception& reason) {
      throw std::runtime_error(path + ":" + std::to_string(line_number) + ": " + reason.what());
    }
  }
  if (segments.empty()) throw std::runtime_error(path + ": contains no segment");
  return segments;
}

}  // namespace sdf_ccd::tools
