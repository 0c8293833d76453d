#include "ros/world/request_files.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

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

Resource RequestFiles::resource(const std::string& uri) const {
  const bool is_elsewhere = uri.find("://") != std::string::npos && !startsWith(uri, kFile);
  if (is_elsewhere) return loader_(uri);
  Resource found = loader_(path(uri));
  path(found.name);  // a name with escaped characters, or in other case, may have been found outside
  return found;
}

}  // namespace sdf_ccd
