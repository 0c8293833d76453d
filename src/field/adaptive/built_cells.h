#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "block_builder.h"
#include "field/adaptive/adaptive_grid.h"

namespace sdf_ccd {

/// Some top cells near the surface, in the form of AdaptiveData: building the cells of a grid in parts takes little
/// more memory than the grid itself. Indices count from the first elements of the part.
struct BuiltCells {
  /// A leaf's error relative to that of a grid whose leaves are all proved, and to that of a grid that is capped (see
  /// BlockBuilder::capped()): which it is, is known last.
  struct ErrorCodes {
    std::uint8_t proved, capped;
  };

  /// A top cell by its index in the grid, and its first elements; the next one's follow its last.
  struct Top {
    std::uint32_t index;
    NodeBases first;
  };

  std::vector<Top> tops;
  std::vector<std::uint8_t> order;  ///< of `tops`, by index
  std::vector<AdaptiveNode> nodes;
  std::vector<NodeBases> bases;
  std::vector<LeafWord> leaves;
  std::vector<SplitLeaves> splits;
  std::vector<ErrorCodes> leaf_errors, split_errors;

  NodeBases size() const {
    return {static_cast<std::uint32_t>(leaves.size()), static_cast<std::uint32_t>(splits.size()),
            static_cast<std::uint32_t>(nodes.size())};
  }
  /// Behind the last elements of a top cell.
  NodeBases end(std::size_t top) const { return top + 1 < tops.size() ? tops[top + 1].first : size(); }
};

/// Appends the cells of a block, in any order, to its BuiltCells.
class CellWriter {
 public:
  /// @param shape   has the error bound of a grid whose leaves are all proved; must outlive this.
  /// @param capped  error bound of a grid that is capped [m].
  CellWriter(const AdaptiveShape& shape, double capped) : shape_(shape), capped_(capped) {}

  /// Adds a top cell unless it is far.
  void add(std::size_t index, BuiltCell&& cell);

  /// The cells, without unused memory; null if there are none.
  std::unique_ptr<const BuiltCells> finish();

 private:
  void addLeaf(const FittedLeaf& leaf);
  void addSplit(BuiltCell& cell);
  void addNode();
  /// Writes a node whose place is there, appends all below it, and frees the cells.
  void writeNode(BuiltCell& cell, std::size_t node, int depth);
  BuiltCells::ErrorCodes codes(double error) const {
    return {leaf_error::code(error, shape_.error_bound), leaf_error::code(error, capped_)};
  }

  const AdaptiveShape& shape_;
  const double capped_;
  BuiltCells built_;
};

}  // namespace sdf_ccd
