#pragma once

#include <clocale>
#include <cstdlib>
#include <locale>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "oracle/files.h"

namespace sdf_ccd::test {

/// A folder with the locale de_DE.UTF-8, for LOCPATH; made by localedef, as few machines have it.
inline const std::string& germanLocaleFolder() {
  static const TemporaryDirectory directory;
  static const std::string folder = directory.path().string();
  static const bool is_made =
      std::system(("localedef -i de_DE -f UTF-8 '" + folder + "/de_DE.UTF-8' > '" + folder + "/log' 2>&1").c_str()) ==
      0;
  static const std::string none;
  return is_made ? folder : none;
}

/// Makes German, in which 1.5 is written 1,5, the locale of this process while it exists: for C and for C++ streams.
class GermanLocale {
 public:
  GermanLocale() {
    if (!isThere()) throw std::logic_error("there is no German locale");
    ::setenv("LOCPATH", germanLocaleFolder().c_str(), 1);
    std::locale::global(std::locale("de_DE.UTF-8"));  // sets that of C, too
    EXPECT_EQ(std::string(std::localeconv()->decimal_point), ",");
  }
  ~GermanLocale() {
    std::locale::global(std::locale::classic());
    ::unsetenv("LOCPATH");
  }
  GermanLocale(const GermanLocale&) = delete;
  GermanLocale& operator=(const GermanLocale&) = delete;

  static bool isThere() { return !germanLocaleFolder().empty(); }
};

}  // namespace sdf_ccd::test

/// At the begin of a test.
#define SDF_CCD_NEEDS_GERMAN_LOCALE() \
  if (!sdf_ccd::test::GermanLocale::isThere()) GTEST_SKIP() << "localedef cannot make de_DE (Debian: locales)"
