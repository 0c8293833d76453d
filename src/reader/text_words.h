#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sdf_ccd {

/// Takes the next word off the front; empty at the end.
std::string_view takeWord(std::string_view& text);

/// Takes the next line off the front that holds more than a comment (`#` to its end); empty at the end.
std::string_view takeLine(std::string_view& text);

/// Takes the next word off the front as a number. None if it is no number, or there is no word.
/// @param text  of something that ends with a byte 0, as a std::string does.
std::optional<double> takeNumber(std::string_view& text);

/// The same as a whole number from 0 on.
std::optional<std::uint64_t> takeCount(std::string_view& text);

/// @throws std::runtime_error that so many elements are announced and no more than `whole` of them are there.
[[noreturn]] void failTruncated(const std::string& element, std::uint64_t announced, std::uint64_t whole);

/// Refuses a count that cannot be: every element takes a byte at the least. @throws std::runtime_error.
std::uint64_t requireRoom(double count, std::size_t bytes, std::string_view line);

}  // namespace sdf_ccd
