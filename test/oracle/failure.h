#pragma once

#include <stdexcept>
#include <string>

namespace sdf_ccd::test {

/// What the Error says that an action throws; empty if it throws nothing. Exceptions of other types pass.
template <typename Error = std::runtime_error, typename Action>
std::string failureOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace sdf_ccd::test
