#include "cache_directory.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace sdf_ccd {
namespace {

namespace fs = std::filesystem;

bool isOwn(const struct stat& status) {
  return status.st_uid == ::geteuid() || status.st_uid == 0;
}

/// @throws std::runtime_error if another user owns this or can write to it.
void requireOwn(const struct stat& status, const std::string& path) {
  if (!isOwn(status)) throw std::runtime_error(path + ": belongs to another user");
  // A group of the user's own is usual.
  const bool by_group = (status.st_mode & S_IWGRP) != 0 && status.st_gid != ::getegid();
  if (by_group || (status.st_mode & S_IWOTH) != 0) throw std::runtime_error(path + ": other users can write to it");
}

/// "hash.field", "hash.shell" and related files.
bool isOfCache(const std::string& file) {
  for (const char* ending : {".field", ".shell", ".field.doubt", ".field.lock", ".shell.lock"}) {
    const std::size_t length = std::strlen(ending);
    if (file.size() > length && file.compare(file.size() - length, length, ending) == 0) return true;
  }
  return false;
}

/// Named as by TemporaryFile: with an extra extension, six characters or the process and a number.
bool isTemporary(const std::string& file) {
  const std::size_t dot = file.rfind('.');
  if (dot == std::string::npos || isOfCache(file) || !isOfCache(file.substr(0, dot))) return false;
  const std::string ending = file.substr(dot + 1);
  const bool is_numbered =
      ending.find('-') != std::string::npos && ending.find_first_not_of("0123456789-") == std::string::npos;
  return ending.size() == 6 || is_numbered;
}

struct Entry {
  fs::path path;
  fs::file_time_type used;
  std::size_t bytes;
};

}  // namespace

void requireOwnDirectory(const std::string& directory) {
  std::error_code error;
  fs::path named(directory);
  if (!named.has_filename()) named = named.parent_path();  // a slash at its end
  const fs::path parent = named.parent_path();
  if (!parent.empty()) fs::create_directories(parent, error);
  if (!error && ::mkdir(directory.c_str(), 0700) != 0 && errno != EEXIST) error = {errno, std::generic_category()};
  struct stat status {};
  if (!error && ::stat(directory.c_str(), &status) != 0) error = {errno, std::generic_category()};
  if (error) throw std::runtime_error(directory + ": " + error.message());
  if (!S_ISDIR(status.st_mode)) throw std::runtime_error(directory + ": is not a directory");
  requireOwn(status, directory);
}

void requireOwnFile(const std::string& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) throw std::runtime_error(path + ": " + std::strerror(errno));
  if (!S_ISREG(status.st_mode)) throw std::runtime_error(path + ": is a symbolic link or not a regular file");
  requireOwn(status, path);
}

void markUsed(const std::string& path) {
  ::utimensat(AT_FDCWD, path.c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
}

void trimCache(const std::string& directory, const std::string& name, std::size_t max_bytes) {
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
  std::vector<Entry> entries;
  std::size_t bytes = 0;
  std::error_code error;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    const std::string file = it->path().filename().string();
    if (!fs::is_regular_file(it->symlink_status(gone))) continue;
    const fs::file_time_type used = fs::last_write_time(it->path(), gone);
    if (gone) continue;
    if (isTemporary(file) && used < old) fs::remove(it->path(), gone);
    if (!isOfCache(file)) continue;
    const std::uintmax_t size = fs::file_size(it->path(), gone);
    if (gone) continue;
    bytes += size;
    // A field's warning goes with the field.
    const bool is_kept = file.compare(0, name.size(), name) == 0 || it->path().extension() == ".doubt";
    if (!is_kept && size > 0) entries.push_back({it->path(), used, size});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (bytes <= max_bytes) return;
    std::error_code gone;
    if (!fs::remove(entry.path, gone)) continue;
    bytes -= entry.bytes;
    fs::remove(entry.path.string() + ".lock", gone);
    fs::remove(entry.path.string() + ".doubt", gone);
  }
}

}  // namespace sdf_ccd
