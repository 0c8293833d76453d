#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sdf_ccd {

/// Takes the next word off the front; empty at the end.
std::string_view takeWord(std::string_view& text);

/// Takes the next line off the front, without its comment (from `#` on); skips lines that are blank then. Empty at the
/// end.
std::string_view takeLine(std::string_view& text);

/// Takes the next word off the front as a number. None if it is no number, or there is no word.
/// @param text  a view into a buffer that is terminated by a zero byte, such as a std::string.
std::optional<double> takeNumber(std::string_view& text);

/// Returns the count as an integer. @throws std::runtime_error, with the header's line, if it is no non-negative
/// integer or exceeds the file's size: every element takes at least one byte.
std::uint64_t requireRoom(double count, std::size_t bytes, std::string_view line);

/// @throws std::runtime_error always: `announced` elements are announced, but only `whole` of them are complete.
[[noreturn]] void failTruncated(std::string_view element, std::uint64_t announced, std::uint64_t whole);

}  // namespace sdf_ccd
