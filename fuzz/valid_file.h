#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "common/files/checked_file.h"
#include "fuzz_input.h"

namespace sdf_ccd::fuzz {

/// Writes an input as a checked file with a valid checksum, so that the reader goes on to the content. The input is the
/// concatenation of sections, each after its size (four bytes); sections missing at its end are left out.
inline void writeWithChecksum(const std::uint8_t* data, std::size_t size, const InputFile& file, const char* kind,
                              std::uint32_t version) {
  constexpr std::size_t kMaxSections = 32;
  std::vector<FileSection> sections;
  while (size >= sizeof(std::uint32_t) && sections.size() < kMaxSections) {
    std::uint32_t bytes = 0;
    std::memcpy(&bytes, data, sizeof bytes);
    data += sizeof bytes;
    size -= sizeof bytes;
    sections.push_back({data, std::min<std::size_t>(bytes, size)});
    data += sections.back().bytes;
    size -= sections.back().bytes;
  }
  writeCheckedFile(file.path(), {kind, version}, sections);
}

/// The inverse of writeWithChecksum(): the input of a file.
inline std::string inputOf(const std::string& path, const char* kind, std::uint32_t version) {
  const auto file = CheckedFile::open(path, {kind, version});
  std::string input;
  for (std::size_t i = 0; i < file->sectionCount(); ++i) {
    std::size_t count = 0;
    const char* bytes = file->section<char>(i, count);
    const auto size = static_cast<std::uint32_t>(count);
    input.append(reinterpret_cast<const char*>(&size), sizeof size);
    input.append(bytes, count);
  }
  return input;
}

}  // namespace sdf_ccd::fuzz
