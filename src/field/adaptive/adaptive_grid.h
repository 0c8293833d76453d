#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/files/view.h"
#include "field/empty_sphere.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Origin, size and accuracy of an adaptive grid.
struct AdaptiveShape {
  /// Levels of nodes below the top grid; and units along a top cell's side. A unit is the side of the smallest block:
  /// half a cell of the last level.
  static constexpr int kMaxDepth = 3;
  static constexpr int kUnits = 128;

  Vector3d origin = Vector3d::Zero();  ///< first corner of the first top cell [m], frame F
  double cell = 0.0;                   ///< side of a top cell [m]
  Vector3i size = Vector3i::Zero();    ///< top cells per axis
  double band = 0.0;                   ///< [m]
  double error_bound = 0.0;  ///< bound on |interpolated − true distance| in every leaf, rounding included [m]; see
                             ///< AdaptiveGrid::leafError() for that of one
  AlignedBox3d surface_box;  ///< of the mesh [m]

  Vector3i units() const { return kUnits * size; }
  double unit() const { return cell / kUnits; }
  std::size_t count() const { return std::size_t(size.x()) * size.y() * size.z(); }
  AlignedBox3d box() const { return {origin, origin + cell * size.cast<double>()}; }
};

/// Eight corner values in eight bytes: seven bits per corner (bit 0 of the corner's index is x, bit 1 y, bit 2 z),
/// relative to an offset whose eight bits are the top bits of the bytes.
using LeafWord = std::uint64_t;

/// How the leaves of one size are rounded. Corners of a cell of side h differ by √3 h at most, because the distance
/// is 1-Lipschitz, so one offset and seven bits hold them to 0.7 % of h.
struct LeafScale {
  double offset = 0.0;  ///< [m] per step
  double corner = 0.0;  ///< [m] per step

  /// For leaves of side h whose corner values have magnitudes of at most `largest` [m].
  static LeafScale forCell(double h, double largest) {
    const double offset = largest / 127.0;
    return {offset, (1.7320508075688772 * h + offset) / 127.0};
  }

  /// Upper bound of the change by rounding [m].
  double rounding() const { return 0.5 * corner; }

  LeafWord encode(const std::array<double, 8>& corners) const;

  std::array<double, 8> decode(LeafWord word) const {
    const double middle = static_cast<std::int8_t>(((word >> 7) & 0x0101010101010101u) * 0x0102040810204080u >> 56);
    const double base = middle * offset - 63.5 * corner;
    std::array<double, 8> values;
    for (int k = 0; k < 8; ++k) values[k] = base + corner * double((word >> (8 * k)) & 0x7F);
    return values;
  }
};

/// A leaf's error bound as a byte: the grid's error bound times 2^(−code / 16).
namespace leaf_error {
/// Rounds the error up, by less than 4.5 %; smaller errors than that of code 255 get this code.
std::uint8_t code(double error, double error_bound);
double error(std::uint8_t code, double error_bound);
}  // namespace leaf_error

/// 4×4×4 children of one cell, x fastest; each code is the child's rank among its node's leaves, splits or nodes, or
/// is the distance of its centre from the surface. The eight children of an octant may share one leaf. One cache line.
struct alignas(64) AdaptiveNode {
  std::array<std::uint8_t, 64> codes;
};

/// First leaf, split and node of a node's children.
struct NodeBases {
  std::uint32_t leaf, split, node;
};

/// Eight leaves of half a cell's side, instead of one leaf: ordered like corners. One cache line.
struct alignas(64) SplitLeaves {
  std::array<LeafWord, 8> leaves;
};

/// The values an adaptive grid is made of.
struct AdaptiveData {
  std::vector<std::uint32_t> top;  ///< a word per top cell, x fastest
  std::vector<AdaptiveNode> nodes;
  std::vector<NodeBases> bases;  ///< one per node
  std::vector<LeafWord> leaves;
  std::vector<SplitLeaves> splits;
  std::vector<std::uint8_t> leaf_errors;  ///< by AdaptiveBlock::index; separate, as walks along segments skip them
};

/// The word of a top cell: its kind in the lowest two bits, and an index or an EmptySphere about a top cell's centre.
namespace top_word {
constexpr std::uint32_t kFar = 0, kLeaf = 1, kSplit = 2, kNode = 3;
constexpr std::uint32_t kKind = 3;
}  // namespace top_word

/// A node's codes.
namespace node_code {
/// First code of each kind. From kWide on: a leaf that the eight children of an octant share, by its rank among the
/// node's shared leaves, which come before its other leaves.
constexpr int kLeaf = 0, kNode = 64, kSplit = 128, kFar = 192, kWide = 248;
constexpr int kFarSteps = 23;  ///< largest magnitude of a far child's distance
/// A far child's distance at its centre, rounded towards zero, in steps of AdaptiveGrid::farStepFor().
inline std::uint8_t far(double steps) {
  const int magnitude = static_cast<int>(std::min(std::floor(std::abs(steps)), double(kFarSteps)));
  return static_cast<std::uint8_t>(kFar + (steps < 0.0 ? 32 : 0) + magnitude);
}
inline double steps(std::uint8_t code) {
  return (code & 32) ? -double(code & 31) : double(code & 31);
}
}  // namespace node_code

/// A cube of the grid: a leaf with eight corner values, or a cell in which |φ| > band.
struct AdaptiveBlock {
  Vector3i low;       ///< first corner [units]
  int side;           ///< [units]
  bool leaf;          ///< false: far from the surface
  LeafWord word;      ///< of a leaf
  std::size_t index;  ///< of a leaf: its position in the array of leaves, or in that of the splits' leaves after it
  /// Of a far block: an empty sphere, and the side of the surface on which the sphere and the whole block lie.
  Vector3d ball_center = Vector3d::Zero();  ///< [units]
  double ball_radius = 0.0;                 ///< [m]
  bool inside = false;
  double upper_bound = 0.0;  ///< far: of |φ| at the block's own centre [m]
};

/// Signed distances in cells whose size follows the shape of the surface (the paper's "future work"): a coarse grid
/// over everything, cells divided 4×4×4 or 2×2×2 only where interpolation needs it, none where |φ| > band.
///
/// Leaves do not share their corners' values, so the interpolation jumps by up to twice the error bound where they
/// meet: a change of sign at a face is a crossing there (design §3.3).
class AdaptiveGrid {
 public:
  /// @throws std::invalid_argument if sizes do not match or an index is out of range.
  AdaptiveGrid(const AdaptiveShape& shape, AdaptiveData data);

  struct Arrays {
    View<std::uint32_t> top;
    View<AdaptiveNode> nodes;
    View<NodeBases> bases;
    View<LeafWord> leaves;
    View<SplitLeaves> splits;
    View<std::uint8_t> leaf_errors;
  };

  /// A grid on memory that `owner` keeps alive (that of a file).
  AdaptiveGrid(const AdaptiveShape& shape, const Arrays& arrays, std::shared_ptr<const void> owner);

  const AdaptiveShape& shape() const { return shape_; }
  const Arrays& arrays() const { return arrays_; }

  /// The block that holds a unit cube, `unit` within shape().units().
  AdaptiveBlock block(const Vector3i& unit) const;

  /// Corner values of a leaf of this many units.
  std::array<double, 8> corners(const AdaptiveBlock& leaf) const { return scale(leaf.side).decode(leaf.word); }

  /// Bound on |interpolated − true distance| in a leaf [m].
  double leafError(const AdaptiveBlock& leaf) const {
    return leaf_error::error(arrays_.leaf_errors[leaf.index], shape_.error_bound);
  }

  /// How leaves of a side of 2^k units are rounded.
  const LeafScale& scale(int side_units) const { return scales_[__builtin_ctz(static_cast<unsigned>(side_units))]; }

  std::size_t leafCount() const { return arrays_.leaves.size + 8 * arrays_.splits.size; }
  std::size_t bytes() const;

  /// Distance per step of a node's far children [m]. The node's cell has the side `node_side` [m]; it was divided
  /// because it may contain |φ| ≤ band [m].
  static double farStepFor(double node_side, double band) { return (band + 1.53 * node_side) / node_code::kFarSteps; }

  /// The rounding of leaves of side h [m] whose cell, or the cell twice as large around it, may contain |φ| ≤ band.
  static LeafScale leafScaleFor(double h, double band) { return LeafScale::forCell(h, band + 3.5 * h); }

 private:
  /// Sizes, and the lengths of the arrays.
  void checkShape() const;
  /// Walks from all top cells: indices; that each node has only one parent, and is at most kMaxDepth levels below the
  /// top cells.
  void checkTree() const;
  void setScales();
  AdaptiveBlock farTopBlock(const Vector3i& low, const EmptySphere& ball) const;

  AdaptiveShape shape_;
  Arrays arrays_;
  std::shared_ptr<const void> owner_;
  std::array<LeafScale, 8> scales_;                         ///< by log2 of the side in units
  std::array<double, AdaptiveShape::kMaxDepth> far_steps_;  ///< farStepFor() of nodes at each depth
};

}  // namespace sdf_ccd
