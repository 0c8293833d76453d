#include "sdf_ccd/field/octomap_surface.h"

#include <stdexcept>

#ifdef SDF_CCD_WITH_OCTOMAP

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include "octree_file.h"
#include "voxel_surface.h"

namespace sdf_ccd {
namespace {

using Cell = VoxelSurface::Cell;

constexpr int kDepth = 16;
constexpr std::int64_t kCells = std::int64_t{1} << kDepth;  // voxels along a side of the whole tree

std::string readFile(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw std::runtime_error("is a directory");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot be opened");
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

template <class Tree>
class SurfaceFinder {
 public:
  SurfaceFinder(const Tree& tree, VoxelSurface& surface) : tree_(tree), surface_(surface) {}

  void find() {
    for (auto leaf = tree_.begin_leafs(); leaf != tree_.end_leafs(); ++leaf) {
      if (!tree_.isNodeOccupied(*leaf)) continue;
      const octomap::OcTreeKey key = leaf.getIndexKey();
      const int level = kDepth - static_cast<int>(leaf.getDepth());
      for (int axis = 0; axis < 3; ++axis) {
        for (const bool upper : {false, true}) addSide({key[0], key[1], key[2]}, level, axis, upper);
      }
    }
  }

 private:
  /// Adds what is free on one side of a cube of 2^level voxels. Goes down only where the other side is divided too.
  void addSide(const Cell& cube, int level, int axis, bool upper) {
    const std::int64_t size = std::int64_t{1} << level;
    Cell beyond = cube;
    beyond[axis] += upper ? size : -1;
    const bool in_tree = beyond[axis] >= 0 && beyond[axis] < kCells;
    const auto* node = in_tree ? tree_.search(toKey(beyond), static_cast<unsigned>(kDepth - level)) : nullptr;
    if (!node || !tree_.nodeHasChildren(node)) {
      if (!node || !tree_.isNodeOccupied(node)) addFaces(cube, size, axis, upper);
      return;
    }
    const std::int64_t half = size / 2;
    Cell part = cube;
    part[axis] += upper ? half : 0;
    for (int i = 0; i < 4; ++i) {
      Cell quarter = part;
      quarter[(axis + 1) % 3] += (i & 1) ? half : 0;
      quarter[(axis + 2) % 3] += (i & 2) ? half : 0;
      addSide(quarter, level - 1, axis, upper);
    }
  }

  void addFaces(const Cell& cube, std::int64_t size, int axis, bool upper) {
    Cell cell = cube;
    if (upper) cell[axis] += size - 1;
    for (std::int64_t u = 0; u < size; ++u) {
      for (std::int64_t v = 0; v < size; ++v) {
        Cell voxel = cell;
        voxel[(axis + 1) % 3] += u;
        voxel[(axis + 2) % 3] += v;
        surface_.addFace(voxel, axis, upper);
      }
    }
  }

  static octomap::OcTreeKey toKey(const Cell& cell) {
    using Key = octomap::key_type;
    return {static_cast<Key>(cell[0]), static_cast<Key>(cell[1]), static_cast<Key>(cell[2])};
  }

  const Tree& tree_;
  VoxelSurface& surface_;
};

template <class Tree>
TriangleMesh surfaceOf(const Tree& tree, double resolution) {
  VoxelSurface surface(resolution, kCells / 2);
  SurfaceFinder<Tree>(tree, surface).find();
  TriangleMesh mesh = surface.take();
  if (mesh.triangles.empty()) throw std::runtime_error("nothing in it is occupied");
  return mesh;
}

TriangleMesh surfaceOf(const std::string& bytes, double& resolution) {
  const OctreeFile file = checkOctreeFile(bytes);
  resolution = file.resolution;
  std::istringstream stream(bytes);
  if (file.format != OctreeFile::Format::kFull) {
    octomap::OcTree tree(file.resolution);
    if (!tree.readBinary(stream)) throw std::runtime_error("OctoMap cannot read it; it says why on stderr");
    return surfaceOf(tree, file.resolution);
  }
  const std::unique_ptr<octomap::AbstractOcTree> tree(octomap::AbstractOcTree::read(stream));
  if (const auto* plain = dynamic_cast<const octomap::OcTree*>(tree.get())) return surfaceOf(*plain, file.resolution);
  if (const auto* color = dynamic_cast<const octomap::ColorOcTree*>(tree.get())) {
    return surfaceOf(*color, file.resolution);
  }
  throw std::runtime_error("OctoMap cannot read it; it says why on stderr");
}

}  // namespace

TriangleMesh loadOctomapSurface(const std::string& path, double& resolution) {
  try {
    return surfaceOf(readFile(path), resolution);
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace sdf_ccd

#else

namespace sdf_ccd {

TriangleMesh loadOctomapSurface(const std::string& path, double&) {
  throw std::runtime_error(path + ": this build has no OctoMap, so it reads no .bt and .ot files");
}

}  // namespace sdf_ccd

#endif
