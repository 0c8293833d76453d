#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace sdf_ccd {

/// A leaf of an OctoMap: a cube of 2^level voxels along each side, with `low` its lowest voxel. Voxel 32768 begins at
/// the map's origin, as in OctoMap.
struct OctreeLeaf {
  std::uint16_t low[3];
  int level;  ///< 0 to 16
  bool is_occupied;
};

/// Encoding of a tree's data in octomap_msgs/Octomap and, after their headers, in OctoMap's files.
enum class OctreeData {
  kBinary,     ///< two bits per child: unknown, free, occupied, or a node that follows
  kFull,       ///< a node's log odds and a byte for its children
  kFullColor,  ///< the same with three bytes of colour between these
};

/// Calls `visit` for each known leaf, in the tree's order; space without a leaf is unknown. Reads never beyond the
/// data, goes no deeper than 16 levels, and allocates nothing; a leaf of the full format is occupied if its log odds
/// are 0 or more, as by OctoMap's default.
/// @throws std::runtime_error if the data is cut short, continues after the tree's end, is deeper than 16 levels, or
/// holds log odds that are not finite. Some leaves may have been visited by then.
void visitLeaves(const std::int8_t* data, std::size_t bytes, OctreeData kind,
                 const std::function<void(const OctreeLeaf&)>& visit);

}  // namespace sdf_ccd
