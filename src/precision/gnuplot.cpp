#include "gnuplot.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "common/files/temporary_file.h"

namespace sdf_ccd::precision {

bool haveGnuplot() {
  return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

/// From a file: a pipe to a gnuplot that ends early would end this process too (SIGPIPE).
void runGnuplot(const std::string& script) {
  const TemporaryFile file((std::filesystem::temp_directory_path() / "sdf_ccd_plot").string());
  std::ofstream stream(file.path());
  stream << script;
  stream.close();
  if (!stream) throw std::runtime_error("gnuplot's script cannot be written");
  if (std::system(("gnuplot '" + file.path() + "'").c_str()) != 0) throw std::runtime_error("gnuplot failed");
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

}  // namespace sdf_ccd::precision
