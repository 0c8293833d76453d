#include "gnuplot.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace sdf_ccd::precision {

bool haveGnuplot() {
  return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

/// From a file: a pipe to a gnuplot that ends early would end this process too (SIGPIPE).
void runGnuplot(const std::string& script) {
  char path[] = "/tmp/sdf_ccd_plot_XXXXXX";
  const int descriptor = ::mkstemp(path);
  if (descriptor < 0) throw std::runtime_error("gnuplot's script cannot be written");
  FILE* file = ::fdopen(descriptor, "w");
  bool is_good = std::fwrite(script.data(), 1, script.size(), file) == script.size();
  is_good &= std::fclose(file) == 0;
  is_good = is_good && std::system((std::string("gnuplot ") + path).c_str()) == 0;
  ::unlink(path);
  if (!is_good) throw std::runtime_error("gnuplot failed");
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

}  // namespace sdf_ccd::precision
