#include "common/files/checked_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/files/checksum.h"
#include "common/files/descriptor.h"
#include "common/files/temporary_file.h"

namespace sdf_ccd {
namespace {

constexpr char kMagic[8] = {'S', 'D', 'F', '_', 'C', 'C', 'D', '\n'};
constexpr std::uint32_t kByteOrder = 0x01020304;
constexpr std::size_t kAlignment = 64;
constexpr std::size_t kMaxSections = 64;
constexpr std::size_t kKeyBytes = 64;  // behind the header, with zeros to its end; the section table follows

struct Header {
  char magic[8];
  char kind[16];
  std::uint32_t version;
  std::uint32_t byte_order;
  std::uint64_t file_bytes;
  std::uint64_t section_count;
  std::uint64_t checksum;  ///< of all that follows, see Checksum
};
static_assert(sizeof(Header) == 56, "the file's layout must not depend on the compiler");

bool isKind(const Header& header, const std::string& kind) {
  char padded[sizeof header.kind] = {};
  std::memcpy(padded, kind.data(), std::min(kind.size(), sizeof padded - 1));
  return std::memcmp(padded, header.kind, sizeof padded) == 0;
}

struct SectionEntry {
  std::uint64_t offset;
  std::uint64_t bytes;
};

constexpr std::size_t kTable = sizeof(Header) + kKeyBytes;  // where the section table begins

std::size_t aligned(std::size_t offset) {
  return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}

/// Opens a file to read: a regular one, so that reading cannot block for ever.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path)
      : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    if (!descriptor_.isOpen()) fail(path, std::strerror(errno));
    struct stat status {};
    if (fstat(descriptor_.number(), &status) != 0 || !S_ISREG(status.st_mode)) fail(path, "not a regular file");
    bytes_ = static_cast<std::size_t>(status.st_size);
  }

  std::size_t bytes() const { return bytes_; }

  Header header() const {
    if (bytes_ < sizeof(Header)) {
      fail(path_, "truncated: " + std::to_string(bytes_) + " bytes are less than a header");
    }
    Header header;
    read(reinterpret_cast<char*>(&header), sizeof header, 0);
    return header;
  }

  /// Reads the rest after the header into `to`, behind the header; returns its checksum.
  std::uint64_t readAfterHeader(char* to) const {
    return Checksum::of(bytes_ - sizeof(Header), [&](std::size_t from, std::size_t bytes) {
      char* part = to + sizeof(Header) + from;
      read(part, bytes, sizeof(Header) + from);
      return part;
    });
  }

 private:
  void read(char* to, std::size_t bytes, std::size_t offset) const {
    while (bytes > 0) {
      const ssize_t n = pread(descriptor_.number(), to, bytes, static_cast<off_t>(offset));
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail(path_, std::string("cannot read: ") + std::strerror(errno));
      if (n == 0) fail(path_, "truncated while it was read");
      to += n;
      bytes -= static_cast<std::size_t>(n);
      offset += static_cast<std::size_t>(n);
    }
  }

  std::string path_;
  Descriptor descriptor_;
  std::size_t bytes_ = 0;
};

void requireHeader(const std::string& path, Header header, const FileKind& kind, std::size_t bytes) {
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) fail(path, "not a file of sdf_ccd");
  if (!isKind(header, kind.name)) {
    header.kind[sizeof header.kind - 1] = '\0';
    fail(path, "holds a " + std::string(header.kind) + ", not a " + kind.name);
  }
  if (header.byte_order != kByteOrder) fail(path, "written in another byte order");
  if (header.version != kind.version) {
    fail(path, "version " + std::to_string(header.version) + ", this program reads " + std::to_string(kind.version));
  }
  if (header.file_bytes < bytes)
    fail(path, "damaged: " + std::to_string(bytes - header.file_bytes) + " bytes too many");
  if (header.file_bytes != bytes) {
    fail(path, "truncated: " + std::to_string(bytes) + " of " + std::to_string(header.file_bytes) + " bytes");
  }
  if (header.section_count > kMaxSections || kTable + header.section_count * sizeof(SectionEntry) > bytes) {
    fail(path, "damaged: " + std::to_string(header.section_count) + " sections");
  }
}

void requireKey(const std::string& path, const char* start, const std::string& key) {
  const char* written = start + sizeof(Header);
  const std::string found(written, strnlen(written, kKeyBytes));
  if (key.empty() || found == key) return;
  fail(path, "was made from other data: " + (found.empty() ? "it has no key" : "its key is \"" + found + "\""));
}

std::vector<FileSection> sectionsOf(const std::string& path, const Header& header, const char* start,
                                    std::size_t bytes) {
  std::vector<FileSection> sections;
  for (std::size_t i = 0; i < header.section_count; ++i) {
    SectionEntry entry;
    std::memcpy(&entry, start + kTable + i * sizeof entry, sizeof entry);
    if (entry.offset > bytes || entry.bytes > bytes - entry.offset || entry.offset % kAlignment != 0) {
      fail(path, "damaged: section " + std::to_string(i) + " lies outside the file");
    }
    sections.push_back({start + entry.offset, entry.bytes});
  }
  return sections;
}

[[noreturn]] void failToWrite(const std::string& path, int error) {
  fail(path, std::string("cannot write: ") + std::strerror(error));
}

/// A file without a name until it is complete, so that it disappears if the process ends before.
class NewFile {
 public:
  explicit NewFile(const std::string& path) try : path_(path), file_(path) {
  } catch (const std::system_error& error) {
    failToWrite(path, error.code().value());
  }
  void write(const void* data, std::size_t bytes) {
    if (!writeAll(file_.descriptor(), data, bytes)) failToWrite(path_, errno);
  }
  void place() {
    if (fsync(file_.descriptor()) != 0) failToWrite(path_, errno);
    try {
      file_.place();
    } catch (const std::system_error& error) {
      failToWrite(path_, error.code().value());
    }
  }

 private:
  std::string path_;
  TemporaryFile file_;
};

}  // namespace

void writeCheckedFile(const std::string& path, const FileKind& kind, const std::vector<FileSection>& sections) {
  if (kind.name.size() >= sizeof(Header::kind) || kind.key.size() >= kKeyBytes || sections.size() > kMaxSections) {
    throw std::invalid_argument("checked file: kind \"" + kind.name + "\", key \"" + kind.key +
                                "\" or section count out of range");
  }
  std::vector<SectionEntry> table;
  std::size_t offset = aligned(kTable + sections.size() * sizeof(SectionEntry));
  for (const FileSection& section : sections) {
    table.push_back({offset, section.bytes});
    offset = aligned(offset + section.bytes);
  }
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  std::memcpy(header.kind, kind.name.data(), kind.name.size());
  header.version = kind.version;
  header.byte_order = kByteOrder;
  header.file_bytes = offset;
  header.section_count = sections.size();

  // Checksummed as it is written: key, table, sections and the zeros between them.
  std::array<char, kKeyBytes> key{};
  std::copy(kind.key.begin(), kind.key.end(), key.begin());
  static constexpr char kZeros[kAlignment] = {};
  const auto eachPiece = [&](auto&& piece) {
    std::size_t at = sizeof(Header);
    const auto emit = [&](const void* data, std::size_t bytes) {
      if (bytes > 0) piece(data, bytes);
      at += bytes;
    };
    emit(key.data(), key.size());
    emit(table.data(), table.size() * sizeof(SectionEntry));
    for (const FileSection& section : sections) {
      emit(kZeros, aligned(at) - at);
      emit(section.data, section.bytes);
    }
    emit(kZeros, aligned(at) - at);
  };
  Checksum checksum;
  eachPiece([&](const void* data, std::size_t bytes) { checksum.add(data, bytes); });
  header.checksum = checksum.digest();

  NewFile file(path);
  file.write(&header, sizeof header);
  eachPiece([&](const void* data, std::size_t bytes) { file.write(data, bytes); });
  file.place();
}

std::shared_ptr<const CheckedFile> CheckedFile::open(const std::string& path, const FileKind& kind) {
  const OpenFile opened(path);
  const Header header = opened.header();
  requireHeader(path, header, kind, opened.bytes());
  Memory memory = allocate(path, opened.bytes());
  auto* start = static_cast<char*>(memory.get());
  if (opened.readAfterHeader(start) != header.checksum) fail(path, "damaged: the checksum does not match");
  requireKey(path, start, kind.key);
  std::vector<FileSection> sections = sectionsOf(path, header, start, opened.bytes());
  return std::shared_ptr<const CheckedFile>(new CheckedFile(path, std::move(memory), std::move(sections)));
}

/// Allocates whole pages, huge ones where the kernel has them.
CheckedFile::Memory CheckedFile::allocate(const std::string& path, std::size_t bytes) {
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) fail(path, "no memory for its " + std::to_string(bytes) + " bytes");
  madvise(memory, bytes, MADV_HUGEPAGE);
  return {memory, Unmap{bytes}};
}

std::size_t CheckedFile::checkedCount(std::size_t i, std::size_t value_size) const {
  if (i >= sections_.size()) fail(path_, "damaged: section " + std::to_string(i) + " is missing");
  if (sections_[i].bytes % value_size != 0) {
    fail(path_, "damaged: the size of section " + std::to_string(i) + " is not a multiple of its values' size");
  }
  return sections_[i].bytes / value_size;
}

void CheckedFile::Unmap::operator()(void* memory) const {
  munmap(memory, bytes);
}

bool isCheckedFile(const std::string& path, const std::string& kind) {
  try {
    const Header header = OpenFile(path).header();
    return std::memcmp(header.magic, kMagic, sizeof kMagic) == 0 && isKind(header, kind);
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace sdf_ccd
