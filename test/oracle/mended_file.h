#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "common/files/checked_file.h"
#include "oracle/random.h"

namespace sdf_ccd::test {

/// Changes the sections of a checked file, and writes it with a valid checksum.
class EditedFile {
 public:
  using Sections = std::vector<std::string>;

  EditedFile(const std::string& path, std::string kind, std::uint32_t version)
      : kind_(std::move(kind)), version_(version) {
    const auto file = CheckedFile::open(path, {kind_, version_});
    for (std::size_t i = 0; i < file->sectionCount(); ++i) {
      std::size_t count = 0;
      const char* data = file->section<char>(i, count);
      sections_.emplace_back(data, count);
    }
  }

  const Sections& sections() const { return sections_; }

  void write(const std::string& path, const std::function<void(Sections&)>& change) const {
    Sections sections = sections_;
    change(sections);
    std::vector<FileSection> views;
    for (const std::string& section : sections) views.push_back({section.data(), section.size()});
    writeCheckedFile(path, {kind_, version_}, views);
  }

 private:
  std::string kind_;
  std::uint32_t version_;
  Sections sections_;
};

/// Overwrites the bytes at `offset` of a section.
template <class Value>
void put(Value value, std::size_t offset, std::string& section) {
  section.replace(offset, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
}

/// Overwrites some bytes with numbers that no writer produces: NaN, infinities, huge or negative numbers, random bits.
inline void breakNumbers(Random& random, EditedFile::Sections& sections) {
  const int count = 1 + int(random() % 3);
  for (int i = 0; i < count; ++i) {
    std::string& section = sections[random() % sections.size()];
    const std::size_t size = random() % 2 ? 8 : 4;
    if (section.size() < size) continue;
    // Often near the beginning, which holds sizes and positions.
    const std::size_t place =
        random() % std::min(section.size() / size, random() % 2 ? std::size_t(24) : section.size());
    constexpr double kDoubles[] = {0.0, -0.0, -1.0, 1e300, -1e300, 1e-300, 1e15, HUGE_VAL, -HUGE_VAL, NAN};
    constexpr float kFloats[] = {-1.0F, 1e30F, HUGE_VALF, -HUGE_VALF, NAN};
    constexpr std::uint32_t kWords[] = {0, 1, 2, 3, 0x7fffffff, 0x80000000, 0xffffffff, 0x00010000};
    if (size == 8) {
      put(random() % 3 ? kDoubles[random() % 10] : std::pow(10.0, uniform(random, -20, 20)), 8 * place, section);
    } else if (random() % 3 == 0) {
      put(kFloats[random() % 5], 4 * place, section);
    } else {
      put(random() % 3 ? kWords[random() % 8] : std::uint32_t(random()), 4 * place, section);
    }
  }
}

}  // namespace sdf_ccd::test
