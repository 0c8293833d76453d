#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>

#include "cell_fit.h"
#include "common/cancel_point.h"
#include "common/lattice.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/cube_corner.h"
#include "field/grid_cell.h"
#include "field/near_octants.h"

namespace sdf_ccd {

/// The content of a cell.
struct BuiltCell {
  enum Kind { kFar, kLeaf, kWide, kSplit, kNode } kind = kFar;
  double distance = 0.0;                             ///< far: at the centre
  FittedLeaf leaf;                                   ///< wide: the leaf that all eight cells of the octant share
  std::unique_ptr<std::array<FittedLeaf, 8>> split;  ///< not in the cell itself: a node has 64 cells, most of them far
  std::unique_ptr<std::array<BuiltCell, 64>> children;
};

/// Index in a node of the k-th cell in an octant.
inline int childIndex(int octant, int k) {
  const Vector3i c = 2 * cubeCorner(octant) + cubeCorner(k);
  return c.x() + 4 * (c.y() + 4 * c.z());
}

/// Receives the cells of a builder.
class CellSink {
 public:
  virtual ~CellSink() = default;

  /// Memory of the field [bytes].
  virtual void count(std::size_t bytes) = 0;
  /// A top cell's distance at its centre [m].
  virtual void addDistance(std::size_t index, double distance) = 0;
  /// A top cell near the surface.
  virtual void add(std::size_t index, BuiltCell&& cell) = 0;
};

/// Builds the cells of an adaptive grid, in cubes of top cells that share a search for the triangles near them.
class BlockBuilder {
 public:
  static constexpr int kSide = 4;  ///< of a block, in top cells

  /// All arguments must outlive this.
  BlockBuilder(const SurfaceIndex& surface, const AdaptiveShape& shape)
      : surface_(surface), shape_(shape), error_(shape.error_bound) {}

  Vector3i blocks() const { return (shape_.size.array() + (kSide - 1)) / kSide; }
  std::size_t count() const { return std::size_t(blocks().x()) * blocks().y() * blocks().z(); }
  /// The i-th block, x fastest.
  Vector3i block(std::size_t i) const { return pointIn(blocks(), i); }
  Vector3d center(const Vector3i& block) const { return center(Block{kSide * block, kSide}); }
  double side() const { return kSide * shape_.cell; }

  /// May be called from several threads at once.
  void build(const Vector3i& block, const SignedSurface::Nearest& at_center, CellSink& sink) const;

  /// Whether a leaf at the last depth could not be proved to meet the error bound.
  bool capped() const { return capped_; }

 private:
  /// A cube of top cells: first cell and side, in cells. The last ones may end beyond the grid.
  struct Block {
    Vector3i low;
    int side;

    Block octant(int k) const { return {low + side / 2 * cubeCorner(k), side / 2}; }
  };
  struct OctantLeaves;

  Vector3d center(const Block& block) const {
    return shape_.origin + shape_.cell * (block.low.cast<double>().array() + 0.5 * block.side).matrix();
  }
  bool withinGrid(const Vector3i& cell) const { return (cell.array() < shape_.size.array()).all(); }
  std::size_t index(const Vector3i& cell) const { return indexIn(shape_.size, cell); }
  /// Whether |φ| > band in all of a cube of this side.
  bool isFar(double center_distance, double side) const {
    return std::abs(center_distance) > shape_.band + kHalfSqrt3 * side * (1.0 + 1e-9);
  }

  void buildNear(const Block& block, const NearTriangles& near, CellSink& sink) const;
  /// Measures the distances at the centres of cells that are all far; each search starts from the previous result.
  void measureFar(const Block& block, SignedSurface::Nearest last, CellSink& sink) const;
  BuiltCell cell(CellFit& fit, const NearTriangles& near, int depth, CellSink& sink) const;
  BuiltCell divide(CellFit& fit, const NearTriangles& near, int depth, OctantLeaves& octants, CellSink& sink) const;
  /// Whether a proved leaf shows that |φ| exceeds the band in all of it, on the side where the cell's centre lies.
  bool provedFar(const LeafScale& scale, LeafWord leaf, double center_distance) const;
  /// Whether a far cell at this depth can store its side: the distance at its centre does not round to zero.
  bool holdsFar(double center_distance, int depth) const;

  const SurfaceIndex& surface_;
  const AdaptiveShape& shape_;
  const double error_;
  const CancelPoint cancel_;
  mutable std::atomic<bool> capped_{false};
};

}  // namespace sdf_ccd
