#include "sdf_ccd/field/file_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace sdf_ccd {
namespace {

/// Held by the one process that makes a file; the kernel frees it if that process dies.
class FileLock {
 public:
  explicit FileLock(const std::string& path) : descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0) throw std::runtime_error(path + ": " + std::strerror(errno));
    while (flock(descriptor_, LOCK_EX) != 0) {
      if (errno == EINTR) continue;
      const std::string reason = std::strerror(errno);
      close(descriptor_);
      throw std::runtime_error(path + ": cannot lock: " + reason);
    }
  }
  ~FileLock() { close(descriptor_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace

CacheOutcome FileCache::get(const std::string& name, const Actions& actions) const {
  CacheOutcome outcome;
  std::unique_ptr<FileLock> lock;
  const std::string path = directory_ + "/" + name;
  if (!directory_.empty()) {
    try {
      std::error_code error;
      std::filesystem::create_directories(directory_, error);
      if (error) throw std::runtime_error(directory_ + ": " + error.message());
      lock = std::make_unique<FileLock>(path + ".lock");
    } catch (const std::runtime_error& error) {
      outcome.warning = std::string("cache not used: ") + error.what();
    }
  }
  if (lock && access(path.c_str(), F_OK) == 0) {
    try {
      actions.load(path);
      outcome.from_cache = true;
      return outcome;
    } catch (const std::runtime_error& error) {
      outcome.warning = std::string("made again: ") + error.what();
    }
  }
  actions.make();
  if (!lock) return outcome;
  try {
    actions.save(path);
  } catch (const std::runtime_error& error) {
    outcome.warning = std::string("not kept: ") + error.what();
  }
  return outcome;
}

}  // namespace sdf_ccd
