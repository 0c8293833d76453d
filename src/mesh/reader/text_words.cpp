#include "text_words.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/read_number.h"

namespace sdf_ccd {
namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";
constexpr std::size_t kShown = 80;  // characters of a line in messages

}  // namespace

std::string_view takeWord(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kSpace));
  text.remove_prefix(word.size());
  return word;
}

std::string_view takeLine(std::string_view& text) {
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(kSpace) != std::string_view::npos) return line;
  }
  return {};
}

std::optional<double> takeNumber(std::string_view& text) {
  const std::string_view word = takeWord(text);
  char* end = nullptr;
  const double value = word.empty() ? 0.0 : readNumber(word.data(), &end);
  if (word.empty() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::uint64_t requireRoom(double count, std::size_t bytes, std::string_view line) {
  if (count >= 0 && count == std::floor(count) && count <= static_cast<double>(bytes)) {
    return static_cast<std::uint64_t>(count);
  }
  throw std::runtime_error("\"" + std::string(line.substr(0, kShown)) + "\" is not a valid count for a file of " +
                           std::to_string(bytes) + " bytes");
}

void failTruncated(std::string_view element, std::uint64_t announced, std::uint64_t whole) {
  throw std::runtime_error("truncated or damaged: " + std::to_string(announced) + " of element " +
                           std::string(element) + " are announced, " + std::to_string(whole) + " are whole");
}

}  // namespace sdf_ccd
