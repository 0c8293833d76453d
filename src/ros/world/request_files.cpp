#include "ros/world/request_files.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "common/files/linkless_path.h"
#include "common/files/temporary_file.h"
#include "common/shown_text.h"

namespace sdf_ccd {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "file://";

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

bool isBelow(const fs::path& path, const fs::path& root) {
  const auto [end, rest] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  (void)rest;
  return end == root.end();
}

}  // namespace

RequestFiles::RequestFiles(std::vector<std::string> roots, ResourceLoader loader)
    : roots_(std::move(roots)), loader_(std::move(loader)) {}

std::string RequestFiles::path(const std::string& file) const {
  const fs::path requested = startsWith(file, kFile) ? file.substr(std::string(kFile).size()) : file;
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(requested, error);
  const auto holds = [&](const std::string& root) {
    std::error_code missing;
    const fs::path folder = fs::canonical(root, missing);
    return !missing && isBelow(canonical, folder);
  };
  const bool allowed = !error && requested.is_absolute() && std::any_of(roots_.begin(), roots_.end(), holds);
  if (!allowed)
    throw std::runtime_error(shownText(file) +
                             ": not an absolute path below one of the folders in the parameter resource_roots");
  return canonical.string();
}

Resource RequestFiles::read(const std::string& file, std::size_t max_bytes) const {
  const std::string found = path(file);
  try {
    return {readWithoutLinks(found, max_bytes), found, ""};
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(shownText(found) + ": " + error.what());
  }
}

Resource RequestFiles::resource(const std::string& uri) const {
  const bool is_elsewhere = uri.find("://") != std::string::npos && !startsWith(uri, kFile);
  if (is_elsewhere) return loader_(uri);
  Resource found = loader_(path(uri));
  // What the loader has read may be outside: by another spelling of the name, or behind a link that came meanwhile.
  found.bytes = read(found.name).bytes;
  return found;
}

void RequestFiles::write(const std::string& file, const std::string& text) const {
  const fs::path target = path(file);
  try {
    TemporaryFile made(openWithoutLinks(target.parent_path(), O_PATH | O_DIRECTORY), target.filename().string());
    if (!writeAll(made.descriptor(), text.data(), text.size())) throw std::system_error(errno, std::generic_category());
    made.place();
  } catch (const std::system_error& error) {
    throw std::runtime_error(shownText(target.string()) + ": cannot be written: " + error.code().message());
  }
}

}  // namespace sdf_ccd
