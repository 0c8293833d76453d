#pragma once

#include <cstdint>

namespace sdf_ccd {

/// The output of sdf_ccd_read on its stdout: this, then either the vertices (three doubles each) and triangles (three
/// int32 each), or the reason as text. All in native byte order: it never leaves the computer.
struct ReadAnswer {
  static constexpr std::uint64_t kMagic = 0x31'6364'6363'6473;  // another version's answers are refused

  std::uint64_t magic = kMagic;
  std::uint64_t reason_bytes = 0;  ///< 0: it was read
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  double resolution = 0.0;  ///< voxel size of an OctoMap [m]
};

/// Exit code of sdf_ccd_read if it needed more memory than it may.
constexpr int kExitOutOfMemory = 3;

}  // namespace sdf_ccd
