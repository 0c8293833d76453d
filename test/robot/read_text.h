#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace sdf_ccd::test {

inline std::string readText(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace sdf_ccd::test
