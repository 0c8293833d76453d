#pragma once

#include <cstdint>
#include <string>

namespace sdf_ccd {

/// Limits for reading a file. The reading process sets them for itself before it looks at the file; the waiting process
/// enforces the wall clock and the size of the answer.
struct ReadLimits {
  std::uint64_t memory = 0;  ///< address space [bytes]
  double cpu_seconds = 0.0;
  double wall_seconds = 0.0;
};

/// Meshes: 512 MiB and 32 times the file's size. OctoMaps, of which a byte may mean many faces: 512 MiB and 2,000 times
/// the file's size, at most 6 GiB. Neither more than three quarters of the computer's memory. Computing: 5 s and 1 s
/// per MiB; by the clock six times that.
/// @param format  as the program sdf_ccd_read takes it: the ending of a mesh's file name, or `octomap`.
ReadLimits limitsOf(const std::string& format, std::uint64_t bytes);

}  // namespace sdf_ccd
