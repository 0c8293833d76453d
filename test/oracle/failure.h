#pragma once

#include <stdexcept>
#include <string>

namespace sdf_ccd::test {

/// The message of the Error that an action throws; empty if it throws none. Exceptions of other types pass through.
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
