#pragma once

#include <cstdint>

namespace sdf_ccd {

/// Header of the output of sdf_ccd_read. After it come either the vertices (three doubles each) and triangles (three
/// int32 each), or the text of the error. All in native byte order, as both processes run on the same computer.
struct ReadAnswer {
  static constexpr std::uint64_t kMagic = 0x31'6364'6363'6473;  // answers of another version are refused

  std::uint64_t magic = kMagic;
  std::uint64_t reason_bytes = 0;  ///< length of the error's text; 0 if the file was read
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  double resolution = 0.0;  ///< voxel size of an OctoMap [m]
};

/// Exit code of sdf_ccd_read if it needed more memory than its limit.
constexpr int kExitOutOfMemory = 3;

}  // namespace sdf_ccd
