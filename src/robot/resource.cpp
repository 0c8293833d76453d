#include "sdf_ccd/robot.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "common/files/regular_file.h"
#include "common/shown_text.h"

namespace sdf_ccd {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& uri, const std::string& reason) {
  throw std::runtime_error(shownText(uri) + ": " + shownText(reason));
}

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// The entry of `directory` that differs from `name` only by case; the first in alphabetical order if there are more.
std::string entryIgnoringCase(const fs::path& directory, const std::string& name) {
  std::string found;
  const std::string wanted = lowerCase(name);
  std::error_code error;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
    const std::string entry = it->path().filename().string();
    if (lowerCase(entry) == wanted && (found.empty() || entry < found)) found = entry;
  }
  return found;
}

/// A path as it is spelled on disk.
struct Spelling {
  fs::path path;     ///< up to the first component that does not exist in any case
  fs::path missing;  ///< that component's path; empty if all exist
  std::string differences;
};

Spelling spellingOnDisk(const fs::path& path) {
  std::error_code error;
  Spelling found;
  found.path = path.root_path();
  for (const fs::path& component : path.relative_path()) {
    if (component.empty() || fs::exists(found.path / component, error)) {
      found.path /= component;
      continue;
    }
    const std::string entry = entryIgnoringCase(found.path, component.string());
    if (entry.empty()) {
      found.missing = found.path / component;
      return found;
    }
    if (!found.differences.empty()) found.differences += ", ";
    found.differences += "found " + shownText(entry) + ", the URI says " + shownText(component.string());
    found.path /= entry;
  }
  return found;
}

/// The path with every component as it is spelled on disk.
/// @param hint  for the user, if there is no such file.
fs::path spelledAsOnDisk(const fs::path& path, const std::string& uri, const std::string& hint, std::string& warning) {
  const Spelling found = spellingOnDisk(path);
  if (!found.missing.empty()) fail(uri, "no such file (" + found.missing.string() + " does not exist)" + hint);
  if (!path.has_filename()) fail(uri, "is a directory");
  if (!found.differences.empty()) warning = shownText(uri) + ": " + found.differences;
  return found.path;
}

std::string readFile(const fs::path& path, const std::string& uri) {
  try {
    return readRegularFile(path.string());
  } catch (const std::exception& error) {
    fail(uri, path.string() + " " + error.what());
  }
}

/// `package://name/path`, also with a third slash before the name.
fs::path packagePath(const std::string& uri, const PackageFinder& packages) {
  std::size_t begin = std::string("package://").size();
  while (begin < uri.size() && uri[begin] == '/') ++begin;
  const std::size_t slash = uri.find('/', begin);
  if (slash == std::string::npos || slash + 1 == uri.size()) fail(uri, "names no file in a package");
  const std::string package = uri.substr(begin, slash - begin);
  const fs::path inside = uri.substr(slash + 1);
  for (const fs::path& component : inside) {
    if (component == "..") fail(uri, "'..' leads out of a package and is not followed");
  }
  const std::string directory = packages ? packages(package) : std::string();
  if (directory.empty()) fail(uri, "no such package: " + package);
  return fs::path(directory) / inside.relative_path();
}

fs::path localPath(const std::string& uri, const PackageFinder& packages, const std::string& base_directory) {
  if (uri.empty()) throw std::runtime_error("an empty URI names no file");
  if (startsWith(uri, "package://")) return packagePath(uri, packages);
  if (startsWith(uri, "file://")) {
    const fs::path path = uri.substr(std::string("file://").size());
    if (!path.is_absolute()) fail(uri, "a file:// URI needs an absolute path");
    return path;
  }
  const std::size_t scheme = uri.find("://");
  if (scheme != std::string::npos) fail(uri, "scheme " + uri.substr(0, scheme) + ":// is not supported");
  return fs::path(base_directory) / uri;  // an absolute path replaces the base
}

/// The text with %XX replaced by the bytes that they stand for.
std::string percentDecoded(const std::string& text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto digit = [&](std::size_t k) {
      return k < text.size() && std::isxdigit(static_cast<unsigned char>(text[k]));
    };
    if (text[i] == '%' && digit(i + 1) && digit(i + 2)) {
      decoded += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

/// The file of a URI, as it is written or, if there is none, with its escaped characters as other readers of URIs take
/// them.
fs::path fileOf(const std::string& uri, const PackageFinder& packages, const std::string& base_directory) {
  const fs::path path = localPath(uri, packages, base_directory);
  const std::string decoded = percentDecoded(uri);
  std::error_code ignored;
  if (decoded == uri || decoded.find('\0') != std::string::npos || fs::exists(path, ignored)) return path;
  const fs::path other = localPath(decoded, packages, base_directory);
  return spellingOnDisk(other).missing.empty() ? other : path;
}

}  // namespace

Resource loadLocalResource(const std::string& uri, const PackageFinder& packages, const std::string& base_directory) {
  Resource resource;
  const fs::path wanted = fileOf(uri, packages, base_directory);
  const std::string hint =
      base_directory.empty() && wanted.is_relative()
          ? ": no folder is known that the name is relative to; a robot_description needs package:// or file://"
          : "";
  const fs::path path = spelledAsOnDisk(fs::absolute(wanted), uri, hint, resource.warning);
  resource.bytes = readFile(path, uri);
  resource.name = path.string();
  return resource;
}

}  // namespace sdf_ccd
