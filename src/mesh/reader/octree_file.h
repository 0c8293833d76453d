#pragma once

#include <cstddef>
#include <string>

namespace sdf_ccd {

/// Header of an OctoMap file.
struct OctreeFile {
  enum class Format { kBinary, kLegacyBinary, kFull };  ///< `.bt`, `.bt` of 2010 without a header, `.ot`
  Format format = Format::kBinary;
  std::string type = "OcTree";
  std::size_t nodes = 0;
  double resolution = 0.0;      ///< voxel size [m]
  std::size_t data_offset = 0;  ///< offset of the first node [bytes]
};

/// Reads the header of an OctoMap file and checks its nodes, so that OctoMap's reader may safely read the file: that
/// reader recurses as deep as a damaged file says, and at the end of a truncated file goes on with uninitialised bytes.
/// @throws std::runtime_error with the reason: not an OctoMap file, truncated, deeper than 16 levels, a wrong number
/// of nodes, a resolution that is not positive, a tree of another type than OcTree and ColorOcTree.
OctreeFile checkOctreeFile(const std::string& bytes);

/// The same file with an unambiguous header: OctoMap parses headers by words, not by lines, so with the original one it
/// might start reading nodes at another offset than the one that was checked.
std::string withPlainHead(const OctreeFile& file, const std::string& bytes);

}  // namespace sdf_ccd
