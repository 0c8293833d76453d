#pragma once

#include <cctype>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace sdf_ccd::test {

/// Names a test by its parameter, as a stream prints it, instead of by its number.
struct ParameterName {
  template <class Parameter>
  std::string operator()(const testing::TestParamInfo<Parameter>& info) const {
    std::ostringstream text;
    text << info.param;
    std::string name = text.str();
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
  }
};

}  // namespace sdf_ccd::test
