#include <gtest/gtest.h>

#include <cstdlib>

#include "precision/gnuplot.h"

namespace sdf_ccd::precision::gnuplot_test {

TEST(Gnuplot, ScriptIsWrittenToTmpdir) {
  if (!haveGnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_NO_THROW(runGnuplot("a = 1\n"));
  ::setenv("TMPDIR", "/nowhere", 1);
  EXPECT_THROW(runGnuplot("a = 1\n"), std::runtime_error);
  ::unsetenv("TMPDIR");
}

}  // namespace sdf_ccd::precision::gnuplot_test
