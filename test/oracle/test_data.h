#pragma once

#include <fstream>
#include <string>

#include <gtest/gtest.h>

namespace sdf_ccd::test {

/// Path of real data, which is not in the repository.
inline std::string dataPath(const std::string& name) {
  return std::string(SDF_CCD_TEST_DATA) + "/" + name;
}

inline bool exists(const std::string& path) {
  return std::ifstream(path).good();
}

}  // namespace sdf_ccd::test

/// Skips the test, naming the file, if the data does not exist.
#define SDF_CCD_NEEDS_DATA(name) \
  if (!sdf_ccd::test::exists(sdf_ccd::test::dataPath(name))) GTEST_SKIP() << "needs " << sdf_ccd::test::dataPath(name)
