#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "oracle/files.h"

namespace sdf_ccd::test {

/// Lets tests replace the program that reads meshes by a shell script.
class FakeReader : public ::testing::Test {
 protected:
  void TearDown() override { ::unsetenv("SDF_CCD_READER"); }

  std::string write(const std::string& name, const std::string& bytes) {
    const std::string path = (directory_ / name).string();
    writeText(path, bytes);
    return path;
  }

  void fake(const std::string& script) {
    const std::string path = write("reader", "#!/bin/sh\n" + script + "\n");
    ::chmod(path.c_str(), 0755);
    ::setenv("SDF_CCD_READER", path.c_str(), 1);
  }

  const TemporaryDirectory directory_;
};

}  // namespace sdf_ccd::test
