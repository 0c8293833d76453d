#include "whole_body.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace sdf_ccd {
namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";

/// Takes the next word off the front; empty at the end.
std::string_view takeWord(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kSpace));
  text.remove_prefix(word.size());
  return word;
}

/// Takes the next line off the front that holds more than a comment; empty at the end.
std::string_view takeLine(std::string_view& text) {
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(kSpace) != std::string_view::npos) return line;
  }
  return {};
}

/// How many words follow a count that begins a list.
std::optional<std::uint64_t> listLength(std::string_view word) {
  std::uint64_t length = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), length);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return length;
}

bool takeWords(std::string_view& text, std::uint64_t count) {
  for (; count > 0; --count) {
    if (takeWord(text).empty()) return false;
  }
  return true;
}

bool takeList(std::string_view& text) {
  const std::optional<std::uint64_t> length = listLength(takeWord(text));
  return length && takeWords(text, *length);
}

[[noreturn]] void fail(const std::string& name, std::uint64_t announced, std::uint64_t whole) {
  throw std::runtime_error("truncated or damaged: " + std::to_string(announced) + " of element " + name +
                           " are announced, " + std::to_string(whole) + " are whole");
}

}  // namespace

void requireWholeAsciiPly(const std::string& bytes, std::size_t body, const std::vector<PlyElement>& elements) {
  std::string_view text = std::string_view(bytes).substr(body);
  for (const PlyElement& element : elements) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const bool is_list : element.is_list) {
        if (!(is_list ? takeList(text) : takeWords(text, 1))) fail(element.name, element.count, i);
      }
    }
  }
}

void requireWholeOff(const std::string& bytes, std::size_t body, std::uint64_t vertices, std::uint64_t faces) {
  std::string_view text = std::string_view(bytes).substr(body);
  for (std::uint64_t i = 0; i < vertices; ++i) {
    std::string_view line = takeLine(text);
    if (!takeWords(line, 3)) fail("vertex", vertices, i);
  }
  for (std::uint64_t i = 0; i < faces; ++i) {
    std::string_view line = takeLine(text);
    if (!takeList(line)) fail("face", faces, i);
  }
}

}  // namespace sdf_ccd
