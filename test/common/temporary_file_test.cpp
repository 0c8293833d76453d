#include "common/files/temporary_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "oracle/files.h"

namespace sdf_ccd::temporary_file_test {

mode_t modeOfFileMadeUnder(mode_t mask) {
  const test::TemporaryDirectory directory;
  const std::string path = (directory / "made").string();
  const mode_t before = ::umask(mask);
  TemporaryFile(path).place();
  ::umask(before);
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 0777;
}

TEST(TemporaryFile, KeepsToTheUsersUmask) {
  EXPECT_EQ(modeOfFileMadeUnder(0077), 0600u);
  EXPECT_EQ(modeOfFileMadeUnder(0022), 0644u);
  EXPECT_EQ(modeOfFileMadeUnder(0), 0644u);
}

}  // namespace sdf_ccd::temporary_file_test
