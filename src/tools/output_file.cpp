#include "output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace sdf_ccd::tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw std::runtime_error(path + ": cannot write: " + reason);
}

constexpr int kMaxLinks = 40;  // as in Linux

/// A path below /proc is an open file: its target may have no name, or be shared with others.
bool isOpenFile(const fs::path& path) {
  return path.string().rfind("/proc/", 0) == 0;
}

/// The target of the path's symbolic links; it need not exist.
fs::path followed(const std::string& path) {
  fs::path target = path;
  for (int i = 0; i < kMaxLinks; ++i) {
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

std::unique_ptr<TemporaryFile> makeTemporary(const std::string& path, const std::string& target) {
  try {
    return std::make_unique<TemporaryFile>(target);
  } catch (const std::system_error& error) {
    fail(path, error.code().message());
  }
}

void moveIntoPlace(const std::string& path, TemporaryFile& temporary) {
  try {
    temporary.place();
  } catch (const std::system_error& error) {
    fail(path, error.code().message());
  }
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, "it is a directory");
  const std::string target = followed(path).string();
  if (isOpenFile(target) || (fs::exists(status) && !fs::is_regular_file(status))) {
    stream_.open(target, std::ios::binary | std::ios::app);
    if (!stream_) fail(path, std::strerror(errno));
    return;
  }
  temporary_ = makeTemporary(path, target);
  stream_.open(temporary_->path(), std::ios::binary);
  if (!stream_) fail(path, std::strerror(errno));
}

OutputFile::~OutputFile() = default;

void OutputFile::close() {
  if (!stream_.is_open()) return;
  errno = 0;
  stream_.close();
  if (!stream_) fail(path_, errno != 0 ? std::strerror(errno) : "not everything could be written");
}

void OutputFile::commit() {
  close();
  if (temporary_) moveIntoPlace(path_, *temporary_);
}

OutputPath::OutputPath(const std::string& path)
    : path_(path), temporary_(makeTemporary(path, followed(path).string())) {}

void OutputPath::commit() {
  moveIntoPlace(path_, *temporary_);
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
