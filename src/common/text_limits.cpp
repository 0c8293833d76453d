#include "text_limits.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace sdf_ccd {
namespace {

void requireSize(const std::string& text, std::size_t most) {
  if (text.size() > most) throw std::runtime_error("it is larger than " + std::to_string(most >> 20) + " MiB");
}

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
  requireSize(xml, kMaxXmlBytes);
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

void requireSoundYaml(const std::string& yaml) {
  requireSize(yaml, kMaxYamlBytes);
  // Depth of flow style by brackets, also those in strings; and of block style by indentation and by the indicators at
  // the start of a line.
  int flow = 0;
  std::size_t position = 0;
  std::vector<std::size_t> indents;
  while (position < yaml.size()) {
    const std::size_t end = std::min(yaml.find('\n', position), yaml.size());
    std::size_t at = position;
    while (at < end && yaml[at] == ' ') ++at;
    if (at < end && yaml[at] != '#') {
      while (!indents.empty() && indents.back() >= at - position) indents.pop_back();
      indents.push_back(at - position);
    }
    int signs = 0;
    for (; at + 1 < end && (yaml[at] == '-' || yaml[at] == '?' || yaml[at] == ':') && yaml[at + 1] == ' '; ++signs) {
      do ++at;
      while (at < end && yaml[at] == ' ');
    }
    for (; at < end; ++at) flow += (yaml[at] == '[' || yaml[at] == '{') - (yaml[at] == ']' || yaml[at] == '}');
    if (flow + signs + static_cast<int>(indents.size()) > kMaxYamlDepth) {
      throw std::runtime_error("it is nested more than " + std::to_string(kMaxYamlDepth) + " levels deep");
    }
    flow = std::max(flow, 0);
    position = end + 1;
  }
}

}  // namespace sdf_ccd
