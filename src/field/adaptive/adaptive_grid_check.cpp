#include <stdexcept>
#include <string>

#include "common/number_text.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/grid_limits.h"

namespace sdf_ccd {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::invalid_argument("adaptive grid: " + what);
}

}  // namespace

void AdaptiveGrid::checkShape() const {
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  if (!positive(shape_.cell)) fail("invalid cell size " + numberText(shape_.cell) + " m");
  if (!shape_.origin.allFinite()) fail("origin is not finite");
  if (!(shape_.band >= 0.0) || !std::isfinite(shape_.band)) fail("invalid band " + numberText(shape_.band) + " m");
  if (!(shape_.error_bound >= 0.0) || !std::isfinite(shape_.error_bound))
    fail("invalid error bound " + numberText(shape_.error_bound) + " m");
  if (shape_.size.minCoeff() < 1 || shape_.size.maxCoeff() > 1024)
    fail("the number of top cells per axis is not within 1 to 1024");
  if (!canResolve(shape_.box(), shape_.unit())) fail("the grid is too far from its origin to resolve its cells");
  if (!isSurfaceBox(shape_.surface_box, shape_.box()))
    fail("the surface's bounding box is not valid, or not within that of the grid");
  if (arrays_.top.size != shape_.count())
    fail(std::to_string(arrays_.top.size) + " words for " + std::to_string(shape_.count()) + " top cells");
  if (arrays_.bases.size != arrays_.nodes.size)
    fail(std::to_string(arrays_.bases.size) + " bases for " + std::to_string(arrays_.nodes.size) + " nodes");
  if (arrays_.leaf_errors.size != leafCount())
    fail(std::to_string(arrays_.leaf_errors.size) + " errors for " + std::to_string(leafCount()) + " leaves");
}

void AdaptiveGrid::checkTree() const {
  const auto inside = [](std::size_t i, std::size_t count) {
    if (i >= count) fail("an index is out of range");
  };
  std::vector<std::uint8_t> depth(arrays_.nodes.size, 0);
  const auto reach = [&](std::size_t node, int d) {
    inside(node, arrays_.nodes.size);
    if (depth[node] != 0) fail("a node has two parents");
    if (d > AdaptiveShape::kMaxDepth) fail("the tree is too deep");
    depth[node] = static_cast<std::uint8_t>(d);
  };
  std::vector<std::uint32_t> pending;
  for (std::size_t i = 0; i < arrays_.top.size; ++i) {
    const std::uint32_t word = arrays_.top[i], index = word >> 2;
    switch (word & top_word::kKind) {
      case top_word::kFar:
        break;
      case top_word::kLeaf:
        inside(index, arrays_.leaves.size);
        break;
      case top_word::kSplit:
        inside(index, arrays_.splits.size);
        break;
      default:
        reach(index, 1);
        pending.push_back(index);
    }
  }
  while (!pending.empty()) {
    const std::uint32_t node = pending.back();
    pending.pop_back();
    const NodeBases& bases = arrays_.bases[node];
    const std::array<std::uint8_t, 64>& codes = arrays_.nodes[node].codes;
    for (int i = 0; i < 64; ++i) {
      constexpr int kFirstOfOctant = 0b101010;  // the upper one of the child's two bits along each axis
      const std::uint8_t code = codes[i], first = codes[i & kFirstOfOctant];
      if (std::max(code, first) >= node_code::kWide && code != first) fail("a leaf fills only a part of its octant");
      if (code >= node_code::kWide) {
        inside(std::size_t(bases.leaf) + (code - node_code::kWide), arrays_.leaves.size);
      } else if (code >= node_code::kFar) {
        continue;
      } else if (code < node_code::kNode) {
        inside(std::size_t(bases.leaf) + code, arrays_.leaves.size);
      } else if (code >= node_code::kSplit) {
        inside(std::size_t(bases.split) + (code - node_code::kSplit), arrays_.splits.size);
      } else {
        const std::size_t child = std::size_t(bases.node) + (code - node_code::kNode);
        reach(child, depth[node] + 1);
        pending.push_back(static_cast<std::uint32_t>(child));
      }
    }
  }
}

}  // namespace sdf_ccd
