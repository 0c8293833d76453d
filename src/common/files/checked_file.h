#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/files/view.h"

namespace sdf_ccd {

/// The content of one section of a checked file.
struct FileSection {
  const void* data;
  std::size_t bytes;
};

template <class T>
FileSection sectionOf(const View<T>& view) {
  return {view.data, view.size * sizeof(T)};
}

/// The kind of a file's content.
struct FileKind {
  std::string name;       ///< up to 15 characters: "field", "shell"
  std::uint32_t version;  ///< of the sections' layout
  std::string key = {};   ///< what the content was made from, up to 63 characters; empty: whatever that was
};

/// Writes sections as one little-endian file with kind, version, key and a checksum over all that follows the header.
/// The file appears under `path` complete or not at all: it gets its name when it is written and synced.
/// @throws std::runtime_error naming the path and the reason.
void writeCheckedFile(const std::string& path, const FileKind& kind, const std::vector<FileSection>& sections);

/// A file of writeCheckedFile(), read into memory of its own: later changes of the file have no effect. Sections
/// are aligned to 64 bytes.
class CheckedFile {
 public:
  /// @param kind  with a key, the file must have that.
  /// @throws std::runtime_error naming the path and what is wrong: missing, not of this kind, another version or key,
  /// truncated, damaged.
  static std::shared_ptr<const CheckedFile> open(const std::string& path, const FileKind& kind);
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;

  std::size_t sectionCount() const { return sections_.size(); }

  /// Section i as values of type T. @throws std::runtime_error if there is none, or its size is no multiple of T's.
  template <class T>
  const T* section(std::size_t i, std::size_t& count) const {
    count = checkedCount(i, sizeof(T));
    return static_cast<const T*>(sections_[i].data);
  }

 private:
  struct Unmap {
    std::size_t bytes;
    void operator()(void* memory) const;
  };
  using Memory = std::unique_ptr<void, Unmap>;
  static Memory allocate(const std::string& path, std::size_t bytes);

  CheckedFile(std::string path, Memory memory, std::vector<FileSection> sections)
      : path_(std::move(path)), memory_(std::move(memory)), sections_(std::move(sections)) {}
  std::size_t checkedCount(std::size_t i, std::size_t value_size) const;

  std::string path_;
  Memory memory_;
  std::vector<FileSection> sections_;
};

/// True if the file begins like one of writeCheckedFile() and holds this kind.
bool isCheckedFile(const std::string& path, const std::string& kind);

}  // namespace sdf_ccd
