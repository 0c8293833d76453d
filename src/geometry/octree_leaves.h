#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace sdf_ccd {

/// A leaf of an OctoMap: a cube of 2^level voxels along each side, from the voxel `low` on. Voxel 32768 begins at the
/// map's origin, as OctoMap counts.
struct OctreeLeaf {
  std::uint16_t low[3];
  int level;  ///< 0 to 16
  bool is_occupied;
};

/// What the bytes of a tree mean, as octomap_msgs/Octomap and OctoMap's files hold them behind their heads.
enum class OctreeData {
  kBinary,     ///< two bits a child: unknown, free, occupied, or a node that follows
  kFull,       ///< a node's log odds and a byte for its children
  kFullColor,  ///< with three bytes of colour between
};

/// Calls `visit` with each known leaf, in the tree's order: what is called with no leaf is unknown. Reads no more than
/// there is, goes no deeper than 16 levels, and allocates nothing; a leaf of the full format is occupied where its log
/// odds are 0 or more, as OctoMap says by default.
/// @throws std::runtime_error if the data is cut short, goes on behind its end, is deeper than 16 levels, or holds a
/// number that is none. Then some leaves may have been visited.
void visitLeaves(const std::int8_t* data, std::size_t bytes, OctreeData kind,
                 const std::function<void(const OctreeLeaf&)>& visit);

}  // namespace sdf_ccd
