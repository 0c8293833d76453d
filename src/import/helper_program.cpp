#include "import/helper_program.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace sdf_ccd {
namespace {

namespace fs = std::filesystem;

fs::path libraryFolder() {
  static const char anchor = 0;
  Dl_info info;
  if (::dladdr(&anchor, &info) == 0 || !info.dli_fname) return {};
  std::error_code error;
  return fs::absolute(info.dli_fname, error).parent_path();
}

// Resolved when the library is loaded: its path may be relative, and the host may change its working directory later.
const fs::path kLibraryFolder = libraryFolder();

}  // namespace

std::string helperProgram(const std::string& name, const char* environment_variable) {
  const char* given = std::getenv(environment_variable);
  if (given && *given) return given;
  for (const fs::path& folder : {kLibraryFolder / "sdf_ccd", kLibraryFolder}) {
    const std::string program = (folder / name).string();
    if (::access(program.c_str(), X_OK) == 0 && !fs::is_directory(program)) return program;
  }
  throw std::runtime_error("cannot find the helper program " + name + " in " + (kLibraryFolder / "sdf_ccd").string() +
                           " or " + kLibraryFolder.string() + "; set the environment variable " + environment_variable +
                           " to its path");
}

}  // namespace sdf_ccd
