#pragma once

#include <string>
#include <vector>

namespace sdf_ccd::test {

/// Small files in test/data/hostile that made readers crash, hang or take gigabytes. All are refused except the prism
/// of two twelve-cornered polygons, which is valid.
inline const std::vector<std::string>& hostileMeshes() {
  static const std::vector<std::string> names = {
      "assimp_11.iqm",         "assimp_11.md2",      "assimp_24.smd",    "node_bomb.dae",         "obj_mtl_segv.obj",
      "off_heap_overflow.off", "off_huge_count.off", "ply_hang_89b.ply", "ply_heap_overflow.ply", "ply_oom.ply"};
  return names;
}

inline std::string hostilePath(const std::string& name) {
  return std::string(SDF_CCD_SOURCE_DIR) + "/test/data/hostile/" + name;
}

}  // namespace sdf_ccd::test
