#include "text_limits.h"

#include <algorithm>
#include <stdexcept>

namespace sdf_ccd {
namespace {

/// Length of the UTF-8 sequence at `position`; 0 if there is none.
std::size_t sequenceAt(const std::string& text, std::size_t position) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(position);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || position + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(position + i) & 0xC0) != 0x80) return 0;
  }
  return length;
}

}  // namespace

void requireXmlSize(const std::string& xml) {
  if (xml.size() > kMaxXmlBytes)
    throw std::runtime_error("it is larger than " + std::to_string(kMaxXmlBytes >> 20) + " MiB");
}

std::string soundText(std::string text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequenceAt(text, i);
    const char c = text[i];
    const bool is_control = static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r';
    if (length == 0 || is_control) text[i] = '?';
    i += std::max<std::size_t>(length, 1);
  }
  return text;
}

}  // namespace sdf_ccd
