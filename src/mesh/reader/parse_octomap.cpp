#include "parse_octomap.h"

#include <stdexcept>

#ifdef SDF_CCD_WITH_OCTOMAP

#include <memory>
#include <sstream>

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include "common/number_text.h"
#include "octree_file.h"
#include "voxel_surface.h"

namespace sdf_ccd {
namespace {

using Cell = VoxelSurface::Cell;

constexpr int kDepth = 16;
constexpr std::int64_t kCells = std::int64_t{1} << kDepth;  // voxels along a side of the whole tree

template <class Tree>
class SurfaceFinder {
 public:
  /// @param surface  receives the faces; if null, they are only counted.
  SurfaceFinder(const Tree& tree, VoxelSurface* surface) : tree_(tree), surface_(surface) {}

  double faces() const { return faces_; }

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
  /// Adds the faces of a cube of 2^level voxels, on one side, whose neighbours are not occupied. Descends only if the
  /// neighbouring node of the same size is divided.
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
    faces_ += static_cast<double>(size) * static_cast<double>(size);
    if (!surface_) return;
    Cell cell = cube;
    if (upper) cell[axis] += size - 1;
    for (std::int64_t u = 0; u < size; ++u) {
      for (std::int64_t v = 0; v < size; ++v) {
        Cell voxel = cell;
        voxel[(axis + 1) % 3] += u;
        voxel[(axis + 2) % 3] += v;
        surface_->addFace(voxel, axis, upper);
      }
    }
  }

  static octomap::OcTreeKey toKey(const Cell& cell) {
    using Key = octomap::key_type;
    return {static_cast<Key>(cell[0]), static_cast<Key>(cell[1]), static_cast<Key>(cell[2])};
  }

  const Tree& tree_;
  VoxelSurface* surface_;
  double faces_ = 0.0;
};

template <class Tree>
ReadMesh surfaceOf(const Tree& tree, double resolution, std::uint64_t max_memory) {
  SurfaceFinder<Tree> counter(tree, nullptr);
  counter.find();
  if (counter.faces() == 0.0) throw std::runtime_error("it has no occupied voxel");
  const std::uint64_t most = max_memory / VoxelSurface::kBytesPerFace;
  if (counter.faces() > static_cast<double>(most)) {
    throw std::runtime_error("its surface has " + numberText(counter.faces()) + " faces of voxels of " +
                             numberText(resolution) + " m; at most " + std::to_string(most) +
                             " are allowed for a file of this size");
  }
  VoxelSurface surface(resolution, kCells / 2);
  SurfaceFinder<Tree>(tree, &surface).find();
  return {surface.take(), resolution};
}

}  // namespace

ReadMesh parseOctomapUnconfined(const std::string& bytes, std::uint64_t max_memory) {
  const OctreeFile file = checkOctreeFile(bytes);
  std::istringstream stream(withPlainHead(file, bytes));
  if (file.format != OctreeFile::Format::kFull) {
    octomap::OcTree tree(file.resolution);
    if (!tree.readBinary(stream)) throw std::runtime_error("OctoMap cannot read it");
    return surfaceOf(tree, file.resolution, max_memory);
  }
  const std::unique_ptr<octomap::AbstractOcTree> tree(octomap::AbstractOcTree::read(stream));
  if (const auto* plain = dynamic_cast<const octomap::OcTree*>(tree.get())) {
    return surfaceOf(*plain, file.resolution, max_memory);
  }
  if (const auto* color = dynamic_cast<const octomap::ColorOcTree*>(tree.get())) {
    return surfaceOf(*color, file.resolution, max_memory);
  }
  throw std::runtime_error("OctoMap cannot read it");
}

}  // namespace sdf_ccd

#else

namespace sdf_ccd {

ReadMesh parseOctomapUnconfined(const std::string&, std::uint64_t) {
  throw std::runtime_error("this build has no OctoMap, so it reads no .bt and .ot files");
}

}  // namespace sdf_ccd

#endif
