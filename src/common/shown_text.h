#pragma once

#include <string>

namespace sdf_ccd {

/// Text from others (a name, a URI, a path), made safe for messages and logs: of bounded length, with its
/// beginning and its end, and without control characters.
inline std::string shownText(std::string text, std::size_t max_bytes = 300) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  }
  if (text.size() <= max_bytes) return text;
  const auto isInside = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80; };  // UTF-8
  std::size_t head = max_bytes / 2, tail = text.size() - max_bytes / 2;
  while (head > 0 && isInside(head)) --head;
  while (tail < text.size() && isInside(tail)) ++tail;
  return text.substr(0, head) + " ... (" + std::to_string(text.size()) + " bytes) ... " + text.substr(tail);
}

}  // namespace sdf_ccd
