// Fuzzes a voxel map as a message holds it, and builds its tiles.
#include <algorithm>

#include "fuzz_input.h"
#include "monitor/map/voxel_map.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  constexpr std::size_t kHead = 4;
  fuzz::Numbers head(data, std::min(size, kHead));
  const bool is_binary = head.below(2) == 0, has_colour = head.below(2) == 0;
  VoxelMapOptions options;
  options.unknown = static_cast<UnknownSpace>(head.below(3));
  options.max_voxels = 20000;  // keeps runs short
  options.max_tiles = 4;
  options.band = 0.05;
  const std::size_t skipped = std::min(size, kHead);
  fuzz::attempt([&] {
    VoxelGrid grid(0.1, options);
    grid.addOctree(reinterpret_cast<const std::int8_t*>(data) + skipped, size - skipped,
                   has_colour ? "ColorOcTree" : "OcTree", is_binary);
    fuzz::require(grid.occupiedCount() <= options.max_voxels, "no more voxels than allowed");
    VoxelMap map("map", "world", options);
    const VoxelMap::Change change = map.update(grid, {});
    for (const BodyDescription& tile : change.made)
      fuzz::require(tile.geometry.front().field.has_value(), "each tile has its field");
    fuzz::require(change.removed.empty(), "nothing was there before");
  });
  return 0;
}
