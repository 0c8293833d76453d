#pragma once

#include <bitset>
#include <optional>

#include "field/near_triangles.h"
#include "field/signed_surface.h"
#include "field/uniform/sparse_grid.h"

namespace sdf_ccd {

/// Signed distances at the points of a brick. The brick is divided into octants, and these again, each with a list of
/// the triangles that may be nearest to its points, until the lists are short.
class BrickSampler {
 public:
  BrickSampler(const Solid& solid, const GridShape& shape);

  const SignedSurface& surface() const { return index_ ? index_->exact() : *surface_; }

  /// Which of a brick's samples to compute, x fastest.
  using Wanted = std::bitset<GridShape::kSamples>;

  /// Sets the samples of a brick that are wanted [m].
  void fill(const Vector3i& brick, const Wanted& wanted, float* samples) const;

 private:
  /// A cube of a brick: first cell and side, in cells.
  struct Block {
    Vector3i low;
    int side;
  };

  Vector3d point(const Vector3i& brick, const Vector3d& cells) const {
    return shape_.origin + shape_.cell * ((GridShape::kBrick * brick).cast<double>() + cells);
  }

  SpaceCube cubeOf(const Vector3i& brick, const Block& block) const {
    const Vector3d center = block.low.cast<double>().array() + 0.5 * block.side;
    return {point(brick, center), block.side * shape_.cell};
  }

  void fill(const Vector3i& brick, const Block& block, const NearTriangles& near, const Wanted& wanted,
            float* samples) const;
  /// For triangles that are small compared with cells, where the lists would be long: searches the tree for each
  /// sample, starting from its neighbour's triangle.
  void fillFromTree(const Vector3i& brick, const Wanted& wanted, float* samples) const;
  /// Makes the distances of samples that are inside negative.
  void setSigns(const Vector3i& brick, const Wanted& wanted, float* samples) const;

  std::optional<SurfaceIndex> index_;  ///< unless triangles are small compared with cells
  std::optional<SignedSurface> surface_;
  GridShape shape_;
};

}  // namespace sdf_ccd
