#pragma once

#include <cstdint>

namespace sdf_ccd::test {

// Versions of the present file formats, of fields and of shells.
constexpr std::uint32_t kFieldVersion = 10, kShellVersion = 7;

}  // namespace sdf_ccd::test
