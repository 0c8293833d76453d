#pragma once

#include <locale.h>
#include <stdlib.h>

#include <cstring>
#include <optional>
#include <string>

/// Numbers in texts. Their decimal sign is the point, whatever the locale of the process: strtod() and streams read 1.5
/// as 1 in a program that has chosen LC_NUMERIC=de_DE, such as one that loads this library.
namespace sdf_ccd {

/// As strtod(): the number at the begin of the text, after blanks.
/// @param end  set behind the number; to `text` if there is none.
inline double readNumber(const char* text, char** end) {
  static const locale_t c_locale = ::newlocale(LC_ALL_MASK, "C", locale_t{});  // never freed: threads may be reading
  return ::strtod_l(text, end, c_locale);
}

/// The number that is the whole text but for blanks around it; none if there is anything else.
inline std::optional<double> wholeNumber(const std::string& text) {
  char* end = nullptr;
  const double number = readNumber(text.c_str(), &end);
  if (end == text.c_str()) return std::nullopt;
  end += std::strspn(end, " \t\r\n\v\f");
  return end == text.c_str() + text.size() ? std::make_optional(number) : std::nullopt;
}

}  // namespace sdf_ccd
