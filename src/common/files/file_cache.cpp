#include "common/files/file_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <thread>

#include "cache_directory.h"
#include "common/cancel_point.h"
#include "common/files/descriptor.h"
#include "common/number_text.h"

namespace sdf_ccd {
namespace {

constexpr auto kPoll = std::chrono::milliseconds(10);

/// Held by the one process that makes a file; the kernel frees it if that process dies. Other users cannot open, and so
/// not hold, its file.
class FileLock {
 public:
  /// @throws std::runtime_error if the lock is not obtained, or not in time; Cancelled.
  FileLock(const std::string& path, double seconds)
      : descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600)) {
    if (!descriptor_.isOpen()) throw std::runtime_error(path + ": " + std::strerror(errno));
    // Polls, as a blocking call could not be cancelled.
    const auto start = std::chrono::steady_clock::now();
    while (flock(descriptor_.number(), LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK && errno != EINTR) {
        throw std::runtime_error(path + ": cannot lock: " + std::strerror(errno));
      }
      checkCancelled();
      if (std::chrono::steady_clock::now() - start > std::chrono::duration<double>(seconds)) {
        throw std::runtime_error(path + ": another process has held it for " + numberText(seconds) + " s");
      }
      std::this_thread::sleep_for(kPoll);
    }
  }

 private:
  Descriptor descriptor_;
};

}  // namespace

/// Identifies a file even if another one takes its name; `exists` is false if there is no file.
struct FileCache::Identity {
  bool exists = false;
  dev_t device = 0;
  ino_t number = 0;
  std::int64_t seconds = 0, nanoseconds = 0;  ///< of its last change

  explicit Identity(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return;
    exists = true;
    device = status.st_dev;
    number = status.st_ino;
    seconds = status.st_ctim.tv_sec;
    nanoseconds = status.st_ctim.tv_nsec;
  }
  bool operator==(const Identity& other) const {
    return exists == other.exists && device == other.device && number == other.number && seconds == other.seconds &&
           nanoseconds == other.nanoseconds;
  }
};

bool FileCache::load(const std::string& name, const Actions& actions, CacheOutcome& outcome) const {
  const std::string path = directory_ + "/" + name;
  try {
    requireOwnFile(path);
    actions.load(path);
    markUsed(path);
    outcome.from_cache = true;
    outcome.file = name;
    outcome.warning.clear();
  } catch (const std::runtime_error& error) {
    outcome.warning = std::string("rebuilt: ") + error.what();
  }
  return outcome.from_cache;
}

CacheOutcome FileCache::get(const std::string& name, const Actions& actions) const {
  CacheOutcome outcome;
  std::unique_ptr<FileLock> lock;
  const std::string path = directory_ + "/" + name;
  const Identity found(directory_.empty() ? "" : path);
  if (!directory_.empty()) {
    try {
      requireOwnDirectory(directory_);
      // Files appear whole, so reading needs no lock: the directory may be one that this process cannot write to.
      if (found.exists && load(name, actions, outcome)) return outcome;
      if (::access(directory_.c_str(), W_OK) != 0) throw std::runtime_error(directory_ + ": " + std::strerror(errno));
      lock = std::make_unique<FileLock>(path + ".lock", lock_seconds_);
    } catch (const std::runtime_error& error) {
      outcome.is_missing = true;
      outcome.warning = std::string("cache unavailable: ") + error.what();
    }
  }
  // Made while this process waited; a file that failed to load before is not read again.
  if (const Identity now(path); lock && now.exists && !(now == found) && load(name, actions, outcome)) return outcome;
  actions.make();
  if (!lock) return outcome;
  try {
    actions.save(path);
    outcome.file = name;
    trimCache(directory_, name, max_bytes_);
  } catch (const std::runtime_error& error) {
    outcome.is_missing = true;
    outcome.warning = std::string("not cached: ") + error.what();
  }
  return outcome;
}

}  // namespace sdf_ccd
