#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <system_error>
#include <vector>

#include <tinyxml2.h>

#include "sdf_ccd/robot.h"

namespace sdf_ccd {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxDepth = 1000;  // as in rospack

bool has(const fs::path& directory, const char* name) {
  std::error_code error;
  return fs::exists(directory / name, error);
}

/// Name of the package that the directory holds, empty if it holds none.
std::string packageName(const fs::path& directory) {
  if (has(directory, "package.xml")) {
    tinyxml2::XMLDocument document;
    if (document.LoadFile((directory / "package.xml").c_str()) != tinyxml2::XML_SUCCESS) return {};
    const tinyxml2::XMLElement* package = document.FirstChildElement("package");
    const tinyxml2::XMLElement* name = package ? package->FirstChildElement("name") : nullptr;
    std::string word;
    if (name && name->GetText()) std::istringstream(name->GetText()) >> word;
    return word;
  }
  return has(directory, "manifest.xml") ? directory.filename().string() : std::string();
}

/// Adds the packages below `directory`. Those that are found first win, as in rospack.
/// @param above  the directories above, without links: a link to one of these is a loop, of which several would take
///               exponential time.
void crawl(const fs::path& directory, std::vector<fs::path>& above, std::map<std::string, std::string>& packages) {
  for (const char* mark : {"CATKIN_IGNORE", "AMENT_IGNORE", "COLCON_IGNORE"}) {
    if (has(directory, mark)) return;
  }
  if (has(directory, "package.xml") || has(directory, "manifest.xml")) {
    const std::string name = packageName(directory);
    if (!name.empty()) packages.emplace(name, directory.string());
    return;
  }
  if (has(directory, "rospack_nosubdirs") || above.size() == kMaxDepth) return;
  std::error_code error;
  const fs::path canonical = fs::canonical(directory, error);
  if (error || std::find(above.begin(), above.end(), canonical) != above.end()) return;
  above.push_back(canonical);
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (it->path().filename().string()[0] != '.' && it->is_directory(ignored)) crawl(it->path(), above, packages);
  }
  above.pop_back();
}

std::map<std::string, std::string> crawlEnvironment() {
  std::map<std::string, std::string> packages;
  const char* variable = std::getenv("ROS_PACKAGE_PATH");
  std::istringstream paths(variable ? variable : "");
  for (std::string path; std::getline(paths, path, ':');) {
    std::error_code error;
    if (!path.empty() && fs::is_directory(path, error)) {
      std::vector<fs::path> above;
      crawl(fs::path(path + "/").parent_path(), above,
            packages);  // without a slash at the end: manifest.xml needs a name
    }
  }
  return packages;
}

}  // namespace

PackageFinder packagesFromEnvironment() {
  struct Packages {
    std::once_flag crawled;
    std::map<std::string, std::string> directories;
  };
  auto packages = std::make_shared<Packages>();
  return [packages](const std::string& package) {
    std::call_once(packages->crawled, [&] { packages->directories = crawlEnvironment(); });
    const auto found = packages->directories.find(package);
    return found == packages->directories.end() ? std::string() : found->second;
  };
}

}  // namespace sdf_ccd
