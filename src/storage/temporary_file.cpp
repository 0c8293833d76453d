#include "storage/temporary_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace sdf_ccd {
namespace {

constexpr mode_t kMode = 0644;  // at most; the user's umask may take more away
constexpr int kMaxNames = 100;  // tried before it is given up

[[noreturn]] void fail() {
  throw std::system_error(errno, std::generic_category());
}

std::string nameBeside(const std::string& target, int number) {
  return target + "." + std::to_string(::getpid()) + "-" + std::to_string(number);
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& target) : target_(target) {
  const std::string directory = std::filesystem::path(target).parent_path().string();
  descriptor_ = Descriptor(::open(directory.empty() ? "." : directory.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kMode));
  path_ = "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor());
  // There is no /proc in some containers.
  if (!descriptor_.isOpen() || ::access(path_.c_str(), W_OK) != 0) openNamed();
}

TemporaryFile::~TemporaryFile() {
  if (!name_.empty()) std::remove(name_.c_str());
}

void TemporaryFile::openNamed() {
  descriptor_.close();
  errno = EEXIST;
  for (int i = 0; i < kMaxNames && !descriptor_.isOpen() && errno == EEXIST; ++i) {
    path_ = nameBeside(target_, i);
    descriptor_ = Descriptor(::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kMode));
  }
  if (!descriptor_.isOpen()) fail();
  name_ = path_;
}

void TemporaryFile::place() {
  if (name_.empty()) giveName();
  if (name_.empty()) return;
  if (std::rename(name_.c_str(), target_.c_str()) != 0) fail();
  name_.clear();
}

/// Gives it the target's name or, because a link does not replace an existing file, a name beside it.
void TemporaryFile::giveName() {
  const auto link = [&](const std::string& name) {
    return ::linkat(AT_FDCWD, path_.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (link(target_)) return;
  for (int i = 0; i < kMaxNames && errno == EEXIST; ++i) {
    const std::string name = nameBeside(target_, i);
    if (!link(name)) continue;
    name_ = name;
    return;
  }
  fail();
}

}  // namespace sdf_ccd
