#include "gnuplot.h"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace sdf_ccd::precision {

bool haveGnuplot() {
  return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

void runGnuplot(const std::string& script) {
  FILE* pipe = ::popen("gnuplot", "w");
  if (!pipe) throw std::runtime_error("gnuplot cannot be run");
  const bool is_written = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  if (::pclose(pipe) != 0 || !is_written) throw std::runtime_error("gnuplot failed");
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

}  // namespace sdf_ccd::precision
