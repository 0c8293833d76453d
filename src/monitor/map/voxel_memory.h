#pragma once

#include <cstddef>
#include <vector>

#include "voxel_grid.h"

namespace sdf_ccd {

/// What a changing map has shown, so that masks hide only the robot's own picture.
///
/// A voxel that was occupied while nothing of the robot was within the padding of it is remembered as an obstacle until
/// a map shows it as free; that a map does not know it any more does not count. Masks hide no remembered voxel, however
/// slowly the robot comes near it: they hide only what has become occupied beside the robot. In the first map they hide
/// everything, as nothing tells which of it was there before the robot; these voxels stay unproven until a map shows
/// them as free, or as occupied while the robot is elsewhere. So do voxels of maps for which it was not known where
/// the robot is.
class VoxelMemory {
 public:
  explicit VoxelMemory(std::size_t max_tiles) : max_tiles_(max_tiles) {}

  struct State {
    TileMap obstacles;  // remembered
    TileMap unproven;
    bool has_map = false;
  };

  /// A map with what is remembered, and what is remembered after it: see accept().
  struct Seen {
    TileMap tiles;              ///< what counts as occupied
    std::size_t masked = 0;     ///< voxels that masks hide
    std::size_t unproven = 0;   ///< of these, those that may be obstacles
    std::size_t unseen = 0;     ///< voxels that count because they are remembered: the map does not know them
    std::size_t forgotten = 0;  ///< remembered voxels, far from the robot, for which there was no room
    State after;
  };

  /// Has a map record what is needed of its free space; before its leaves are added.
  void watch(VoxelGrid& grid) const;

  /// @param masks  of the robot's bodies, also where their poses are guesses.
  /// @param is_robot_known  whether each body of the robot has one; else nothing new is remembered.
  /// @param is_again  the map is the last accepted one, of which more poses are known now.
  /// @throws as VoxelGrid::occupied().
  Seen see(const VoxelGrid& grid, const std::vector<VoxelMask>& masks, bool is_robot_known, bool is_again) const;

  /// Remembers the result of see().
  void accept(State after, bool is_again);

  /// The next map is the first one again.
  void forget() { before_ = now_ = State(); }

 private:
  std::size_t limit(TileMap& remembered, const VoxelGrid& grid, const std::vector<VoxelMask>& masks) const;

  std::size_t max_tiles_;
  State before_, now_;  // the last map; without and with it
};

}  // namespace sdf_ccd
