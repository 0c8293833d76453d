#include "output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace sdf_ccd::tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw std::runtime_error(path + ": cannot write: " + reason);
}

constexpr int kMostLinks = 40;  // as Linux follows

/// A name below /proc is an open file's: what it leads to may have no name of its own, or be shared with others.
bool isOpenFile(const fs::path& path) {
  return path.string().rfind("/proc/", 0) == 0;
}

/// Where the path's symbolic links lead; nothing need be there.
fs::path followed(const std::string& path) {
  fs::path target = path;
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code error;
    const fs::path directory = fs::canonical(target.has_parent_path() ? target.parent_path() : ".", error);
    if (error) fail(path, error.message());
    target = directory / target.filename();
    if (isOpenFile(target) || !fs::is_symlink(target, error)) return target;
    const fs::path next = fs::read_symlink(target, error);
    if (error) fail(path, error.message());
    target = directory / next;
  }
  fail(path, std::strerror(ELOOP));
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, "it is a directory");
  target_ = followed(path).string();
  if (isOpenFile(target_) || (fs::exists(status) && !fs::is_regular_file(status))) {
    stream_.open(target_, std::ios::binary | std::ios::app);
    if (!stream_) fail(path, std::strerror(errno));
    return;
  }
  temporary_ = target_ + ".XXXXXX";
  const int descriptor = ::mkstemp(&temporary_[0]);
  if (descriptor < 0) {
    temporary_.clear();
    fail(path, std::strerror(errno));
  }
  ::fchmod(descriptor, 0644);
  ::close(descriptor);
  stream_.open(temporary_, std::ios::binary);
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void OutputFile::commit() {
  stream_.close();
  if (!stream_) fail(path_, std::strerror(errno));
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, std::strerror(errno));
  temporary_.clear();
}

OutputPath::~OutputPath() {
  std::remove(part().c_str());
}

void OutputPath::commit() {
  if (std::rename(part().c_str(), path_.c_str()) != 0) fail(path_, std::strerror(errno));
}

OutputDirectory::OutputDirectory(const std::string& path) : path_(path) {
  std::error_code error;
  is_new_ = fs::create_directories(path, error);
  if (error) fail(path, error.message());
  if (!fs::is_directory(path, error)) fail(path, "it is not a directory");
  if (::access(path.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
}

OutputDirectory::~OutputDirectory() {
  std::error_code error;
  if (is_new_) fs::remove(path_, error);  // only if it is empty
}

}  // namespace sdf_ccd::tools
