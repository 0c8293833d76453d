#include "build_adaptive.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>

#include <tbb/concurrent_vector.h>

#include "adaptive_shape.h"
#include "block_builder.h"
#include "common/number_text.h"
#include "common/parallel_for.h"
#include "common/progress_counter.h"
#include "field/empty_sphere_search.h"
#include "field/spread_order.h"

namespace sdf_ccd {
namespace {

class AdaptiveBuilder : private CellTaker {
 public:
  AdaptiveBuilder(const Solid& solid, const AdaptiveShape& shape, std::size_t max_bytes)
      : surface_(solid), shape_(shape), error_(shape.error_bound), max_bytes_(max_bytes), blocks_(surface_, shape_) {}

  AdaptiveGrid build(const Progress& progress);

 private:
  void count(std::size_t bytes) override;
  void takeDistance(std::size_t index, double distance) override {
    centers_[index] = static_cast<float>(distance / shape_.cell);
  }
  void take(std::size_t index, BuiltCell&& cell) override { built_.emplace_back(index, std::move(cell)); }

  void buildBlocks(const Progress& progress);
  /// Sets the words of all top cells; those of cells near the surface are replaced later.
  void setEmptySpheres();
  void flatten(const BuiltCell& cell, std::size_t node, int depth);
  void addLeaf(const FittedLeaf& leaf);
  void addSplit(const std::array<FittedLeaf, 8>& split);

  SurfaceIndex surface_;
  AdaptiveShape shape_;
  double error_;
  std::size_t max_bytes_;
  BlockBuilder blocks_;
  std::vector<float> centers_;  ///< distances at the top cells' centres [top cells]
  tbb::concurrent_vector<std::pair<std::size_t, BuiltCell>> built_;  ///< top cells near the surface, in no order
  const CancelPoint cancel_;
  std::atomic<std::size_t> bytes_{0};
  AdaptiveData data_;
  std::vector<std::uint8_t> split_errors_;  ///< of the splits' leaves; appended to AdaptiveData::leaf_errors last
};

void AdaptiveBuilder::count(std::size_t bytes) {
  if ((bytes_ += bytes) > max_bytes_) {
    throw std::length_error("field: a maximum error of " + numberText(error_) + " m needs more than the limit of " +
                            std::to_string(max_bytes_ >> 20) + " MB; choose a larger max_error");
  }
}

void AdaptiveBuilder::buildBlocks(const Progress& progress) {
  const Vector3i blocks = blocks_.blocks();
  std::vector<SignedSurface::Nearest> nearest(blocks_.count());
  parallelFor(0, blocks.y() * blocks.z(), [&](int row) {
    const SignedSurface& exact = surface_.exact();
    for (int x = 0; x < blocks.x(); ++x) {
      const std::size_t i = std::size_t(row) * blocks.x() + x;
      const Vector3d center = blocks_.center(blocks_.block(i));
      nearest[i] = x == 0 ? exact.nearest(center) : exact.next(center, nearest[i - 1], blocks_.side());
    }
  });
  // Spread over the grid, so that the part done is at any time a fair sample of the whole.
  const SpreadOrder order(nearest.size());
  ProgressCounter counter(progress, nearest.size());
  parallelFor(std::size_t{0}, nearest.size(), [&](std::size_t k) {
    const std::size_t i = order[k];
    blocks_.build(blocks_.block(i), nearest[i], *this);
    counter.add();
  });
}

void AdaptiveBuilder::addLeaf(const FittedLeaf& leaf) {
  data_.leaves.push_back(leaf.word);
  data_.leaf_errors.push_back(leaf_error::code(leaf.error, shape_.error_bound));
}

void AdaptiveBuilder::addSplit(const std::array<FittedLeaf, 8>& split) {
  SplitLeaves& leaves = data_.splits.emplace_back();
  for (int k = 0; k < 8; ++k) {
    leaves.leaves[k] = split[k].word;
    split_errors_.push_back(leaf_error::code(split[k].error, shape_.error_bound));
  }
}

void AdaptiveBuilder::flatten(const BuiltCell& cell, std::size_t node, int depth) {
  NodeBases& bases = data_.bases[node];
  bases = {static_cast<std::uint32_t>(data_.leaves.size()), static_cast<std::uint32_t>(data_.splits.size()),
           static_cast<std::uint32_t>(data_.nodes.size())};
  const double step = AdaptiveGrid::farStepFor(shape_.cell / double(1 << (2 * depth)), shape_.band);
  std::array<std::uint8_t, 64>& codes = data_.nodes[node].codes;
  int leaves = node_code::kLeaf, splits = node_code::kSplit, nodes = node_code::kNode;
  for (int half = 0; half < 8; ++half) {
    const BuiltCell& first = (*cell.children)[childIndex(half, 0)];
    if (first.kind != BuiltCell::kWide) continue;
    addLeaf(first.leaf);
    for (int k = 0; k < 8; ++k) codes[childIndex(half, k)] = static_cast<std::uint8_t>(node_code::kWide + leaves);
    ++leaves;
  }
  for (int i = 0; i < 64; ++i) {
    const BuiltCell& child = (*cell.children)[i];
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
        addSplit(child.split);
        code = splits++;
        break;
      case BuiltCell::kNode:
        code = nodes++;
        break;
    }
    codes[i] = static_cast<std::uint8_t>(code);
  }
  std::size_t next = bases.node;
  data_.nodes.resize(data_.nodes.size() + (nodes - node_code::kNode));
  data_.bases.resize(data_.nodes.size());
  for (const BuiltCell& child : *cell.children) {
    if (child.kind == BuiltCell::kNode) flatten(child, next++, depth + 1);
  }
}

void AdaptiveBuilder::setEmptySpheres() {
  data_.top.resize(shape_.count());
  const EmptySphereSearch search(EmptySphereSearch::Lattice::kCenters, shape_.size, centers_);
  parallelFor(0, shape_.size.z(), [&](int z) {
    std::size_t index = std::size_t(z) * shape_.size.x() * shape_.size.y();
    for (int y = 0; y < shape_.size.y(); ++y)
      for (int x = 0; x < shape_.size.x(); ++x) data_.top[index++] = search.ball({x, y, z}).word();
  });
}

AdaptiveGrid AdaptiveBuilder::build(const Progress& progress) {
  count(shape_.count() * sizeof(std::uint32_t));
  centers_.resize(shape_.count());
  buildBlocks(progress);

  if (blocks_.capped()) {
    // Leaves of the last depth that are not proved have the error bound of any 1-Lipschitz function.
    const double side = shape_.unit();
    shape_.error_bound = std::max(error_, kHalfSqrt3 * side + AdaptiveGrid::leafScaleFor(side, shape_.band).rounding());
  }
  setEmptySpheres();
  std::sort(built_.begin(), built_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [index, cell] : built_) {
    cancel_.check();
    std::uint32_t& word = data_.top[index];
    switch (cell.kind) {
      case BuiltCell::kFar:
      case BuiltCell::kWide:  // only in nodes
        break;
      case BuiltCell::kLeaf:
        word = static_cast<std::uint32_t>(data_.leaves.size() << 2) | top_word::kLeaf;
        addLeaf(cell.leaf);
        break;
      case BuiltCell::kSplit:
        word = static_cast<std::uint32_t>(data_.splits.size() << 2) | top_word::kSplit;
        addSplit(cell.split);
        break;
      case BuiltCell::kNode:
        word = static_cast<std::uint32_t>(data_.nodes.size() << 2) | top_word::kNode;
        data_.nodes.emplace_back();
        data_.bases.emplace_back();
        flatten(cell, data_.nodes.size() - 1, 0);
        cell.children.reset();
        break;
    }
  }
  data_.leaf_errors.insert(data_.leaf_errors.end(), split_errors_.begin(), split_errors_.end());
  return {shape_, std::move(data_)};
}

}  // namespace

std::shared_ptr<const AdaptiveGrid> buildAdaptive(const Solid& solid, const FieldOptions& options,
                                                  const Progress& progress) {
  const AdaptiveShape shape = adaptiveShape(boundingBox(solid.boundary()), options);
  return std::make_shared<const AdaptiveGrid>(AdaptiveBuilder(solid, shape, options.max_bytes).build(progress));
}

}  // namespace sdf_ccd
