#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

namespace sdf_ccd::test {

/// Puts a shell script in the place of the program that reads meshes.
class FakeReader : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / ("sdf_ccd_reader_" + std::to_string(::getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override {
    ::unsetenv("SDF_CCD_READER");
    std::filesystem::remove_all(directory_);
  }

  std::string write(const std::string& name, const std::string& bytes) {
    const std::string path = (directory_ / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  void fake(const std::string& script) {
    const std::string path = write("reader", "#!/bin/sh\n" + script + "\n");
    ::chmod(path.c_str(), 0755);
    ::setenv("SDF_CCD_READER", path.c_str(), 1);
  }

  std::filesystem::path directory_;
};

}  // namespace sdf_ccd::test
