#include "common/files/temporary_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

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

TemporaryFile::TemporaryFile(const std::string& target) : target_(std::filesystem::path(target).filename().string()) {
  std::string directory = std::filesystem::path(target).parent_path().string();
  if (directory.empty()) directory = ".";
  folder_ = Descriptor(::open(directory.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!folder_.isOpen()) fail();
  open(directory);
}

TemporaryFile::TemporaryFile(Descriptor folder, const std::string& name) : folder_(std::move(folder)), target_(name) {
  open(".");
}

TemporaryFile::~TemporaryFile() {
  if (!name_.empty()) ::unlinkat(folder_.number(), name_.c_str(), 0);
}

void TemporaryFile::open(const std::string& directory) {
  descriptor_ = Descriptor(::openat(folder_.number(), ".", O_TMPFILE | O_RDWR | O_CLOEXEC, kMode));
  path_ = "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor());
  // There is no /proc in some containers.
  if (!descriptor_.isOpen() || ::access(path_.c_str(), W_OK) != 0) openNamed(directory);
}

void TemporaryFile::openNamed(const std::string& directory) {
  descriptor_.close();
  errno = EEXIST;
  std::string name;
  for (int i = 0; i < kMaxNames && !descriptor_.isOpen() && errno == EEXIST; ++i) {
    name = nameBeside(target_, i);
    descriptor_ = Descriptor(::openat(folder_.number(), name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kMode));
  }
  if (!descriptor_.isOpen()) fail();
  name_ = name;
  path_ = directory + "/" + name;
}

void TemporaryFile::place() {
  if (name_.empty()) giveName();
  if (name_.empty()) return;
  if (::renameat(folder_.number(), name_.c_str(), folder_.number(), target_.c_str()) != 0) fail();
  name_.clear();
}

/// Gives it the target's name or, because a link does not replace an existing file, a name beside it.
void TemporaryFile::giveName() {
  const auto link = [&](const std::string& name) {
    return ::linkat(AT_FDCWD, path_.c_str(), folder_.number(), name.c_str(), AT_SYMLINK_FOLLOW) == 0;
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
