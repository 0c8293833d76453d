#include "built_cells.h"

#include <algorithm>
#include <numeric>

namespace sdf_ccd {

void CellWriter::add(std::size_t index, BuiltCell&& cell) {
  if (cell.kind == BuiltCell::kFar) return;
  built_.tops.push_back({static_cast<std::uint32_t>(index), built_.size()});
  if (cell.kind == BuiltCell::kLeaf) {
    addLeaf(cell.leaf);
  } else if (cell.kind == BuiltCell::kSplit) {
    addSplit(cell);
  } else {
    addNode();
    writeNode(cell, built_.nodes.size() - 1, 0);
  }
}

std::unique_ptr<const BuiltCells> CellWriter::finish() {
  if (built_.tops.empty()) return nullptr;
  std::vector<BuiltCells::Top>& tops = built_.tops;
  built_.order.resize(tops.size());
  std::iota(built_.order.begin(), built_.order.end(), std::uint8_t{0});
  std::sort(built_.order.begin(), built_.order.end(), [&](int a, int b) { return tops[a].index < tops[b].index; });
  tops.shrink_to_fit();
  built_.nodes.shrink_to_fit();
  built_.bases.shrink_to_fit();
  built_.leaves.shrink_to_fit();
  built_.splits.shrink_to_fit();
  built_.leaf_errors.shrink_to_fit();
  built_.split_errors.shrink_to_fit();
  return std::make_unique<const BuiltCells>(std::move(built_));
}

void CellWriter::addLeaf(const FittedLeaf& leaf) {
  built_.leaves.push_back(leaf.word);
  built_.leaf_errors.push_back(codes(leaf.error));
}

void CellWriter::addSplit(BuiltCell& cell) {
  SplitLeaves& leaves = built_.splits.emplace_back();
  for (int k = 0; k < 8; ++k) {
    const FittedLeaf& leaf = (*cell.split)[k];
    leaves.leaves[k] = leaf.word;
    built_.split_errors.push_back(codes(leaf.error));
  }
  cell.split.reset();
}

void CellWriter::addNode() {
  built_.nodes.emplace_back();
  built_.bases.emplace_back();
}

void CellWriter::writeNode(BuiltCell& cell, std::size_t node, int depth) {
  built_.bases[node] = built_.size();
  const double step = AdaptiveGrid::farStepFor(shape_.cell / double(1 << (2 * depth)), shape_.band);
  std::array<std::uint8_t, 64>& codes = built_.nodes[node].codes;
  int leaves = node_code::kLeaf, splits = node_code::kSplit, nodes = node_code::kNode;
  for (int half = 0; half < 8; ++half) {
    const BuiltCell& first = (*cell.children)[childIndex(half, 0)];
    if (first.kind != BuiltCell::kWide) continue;
    addLeaf(first.leaf);
    for (int k = 0; k < 8; ++k) codes[childIndex(half, k)] = static_cast<std::uint8_t>(node_code::kWide + leaves);
    ++leaves;
  }
  for (int i = 0; i < 64; ++i) {
    BuiltCell& child = (*cell.children)[i];
    int code = 0;
    switch (child.kind) {
      case BuiltCell::kFar:
        code = node_code::far(child.distance / step);
        break;
      case BuiltCell::kLeaf:
        addLeaf(child.leaf);
        code = leaves++;
        break;
      case BuiltCell::kWide:
        continue;
      case BuiltCell::kSplit:
        addSplit(child);
        code = splits++;
        break;
      case BuiltCell::kNode:
        code = nodes++;
        break;
    }
    codes[i] = static_cast<std::uint8_t>(code);
  }
  std::size_t next = built_.nodes.size();
  for (; nodes > node_code::kNode; --nodes) addNode();
  for (BuiltCell& child : *cell.children) {
    if (child.kind == BuiltCell::kNode) writeNode(child, next++, depth + 1);
  }
  cell.children.reset();
}

}  // namespace sdf_ccd
