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

/// Limits for a file of this size. Memory: for meshes 512 MiB plus 32 times the file's size; for OctoMaps, in which one
/// byte may stand for many faces, 512 MiB plus 2,000 times the file's size, at most 6 GiB; never more than three
/// quarters of the computer's memory, but at least 512 MiB. CPU time: 5 s plus 1 s per MiB. Wall-clock time: six times
/// that.
/// @param format  argument of the program sdf_ccd_read: the ending of a mesh's file name, or `octomap`.
ReadLimits limitsOf(const std::string& format, std::uint64_t bytes);

}  // namespace sdf_ccd
