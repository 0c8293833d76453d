#pragma once

#include <cstddef>
#include <string>

namespace sdf_ccd {

/// What the head of an OctoMap file says.
struct OctreeFile {
  enum class Format { kBinary, kLegacyBinary, kFull };  ///< `.bt`, `.bt` of 2010 without a header, `.ot`
  Format format = Format::kBinary;
  std::string type = "OcTree";
  std::size_t nodes = 0;
  double resolution = 0.0;      ///< voxel size [m]
  std::size_t data_offset = 0;  ///< where the nodes begin
};

/// Reads the head of an OctoMap file and walks over its nodes, so that OctoMap's reader can be given it: that one
/// descends as deep as a damaged file says, and where the file ends it goes on with bytes that were never read.
/// @throws std::runtime_error with the reason: not an OctoMap file, truncated, deeper than 16 levels, a wrong number
/// of nodes, a resolution that is not positive, a type of tree that holds no plain occupancy.
OctreeFile checkOctreeFile(const std::string& bytes);

/// The same file under a head that can be parsed in one way only: OctoMap divides heads into words, not lines, so it
/// might take other bytes for the nodes than those that were checked.
std::string withPlainHead(const OctreeFile& file, const std::string& bytes);

}  // namespace sdf_ccd
