#include "common/files/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "common/cancel_point.h"
#include "common/files/descriptor.h"
#include "common/files/linkless_path.h"
#include "common/shown_text.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 24,
                      kUnknown = std::size_t{1} << 12;  // of what is known to come, or not

void requireRegular(const struct stat& status) {
  if (S_ISDIR(status.st_mode)) throw std::runtime_error("is a directory");
  if (!S_ISREG(status.st_mode)) throw std::runtime_error("is not a regular file");
}

/// @param why  an errno.
[[noreturn]] void failToOpen(const std::string& path, int why) {
  std::string reason = std::string("cannot be opened: ") + std::strerror(why);
  std::error_code unknown;
  const std::filesystem::path folder = std::filesystem::current_path(unknown);
  if (why == ENOENT && !unknown && std::filesystem::path(path).is_relative()) reason += " in " + folder.string();
  throw std::runtime_error(reason);
}

[[noreturn]] void failTooLarge(std::size_t max_bytes) {
  throw std::runtime_error("larger than " + std::to_string(max_bytes >> 20) + " MiB");
}

std::string readAll(const Descriptor& file, const struct stat& status, std::size_t max_bytes) {
  requireRegular(status);
  if (status.st_size > 0 && static_cast<std::size_t>(status.st_size) > max_bytes) failTooLarge(max_bytes);

  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(status.st_size) + kUnknown);
  for (std::size_t have = 0;;) {
    checkCancelled();
    // The size is only a hint: the file may grow or shrink meanwhile, and those of /proc say 0.
    const std::size_t known = static_cast<std::size_t>(status.st_size);
    bytes.resize(have < known ? std::min(have + kChunk, known + 1) : have + kUnknown);
    const ssize_t count = ::read(file.number(), &bytes[have], bytes.size() - have);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw std::runtime_error("cannot be read");
    have += static_cast<std::size_t>(count);
    bytes.resize(have);
    if (count == 0) return bytes;
    if (have > max_bytes) failTooLarge(max_bytes);
  }
}

constexpr int kReadOnly = O_RDONLY | O_NONBLOCK | O_NOCTTY;

}  // namespace

std::string readRegularFile(const std::string& path, std::size_t max_bytes) {
  // Checked before opening, as opening some devices has effects; and after, as it may be another file by then.
  struct stat status;
  if (::stat(path.c_str(), &status) != 0) failToOpen(path, errno);
  requireRegular(status);
  const Descriptor file(::open(path.c_str(), kReadOnly | O_CLOEXEC));
  if (!file.isOpen() || ::fstat(file.number(), &status) != 0) failToOpen(path, errno);
  return readAll(file, status, max_bytes);
}

std::string readNamedFile(const std::string& path, std::size_t max_bytes) {
  try {
    return readRegularFile(path, max_bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(shownText(path) + ": " + error.what());
  }
}

std::string readWithoutLinks(const std::string& path, std::size_t max_bytes) {
  struct stat status;
  if (::lstat(path.c_str(), &status) != 0) failToOpen(path, errno);
  requireRegular(status);
  try {
    const Descriptor file = openWithoutLinks(path, kReadOnly);
    if (::fstat(file.number(), &status) != 0) failToOpen(path, errno);
    return readAll(file, status, max_bytes);
  } catch (const std::system_error& error) {
    failToOpen(path, error.code().value());
  }
}

}  // namespace sdf_ccd
