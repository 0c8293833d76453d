#include "build_adaptive.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>

#include "adaptive_shape.h"
#include "block_builder.h"
#include "built_cells.h"
#include "common/cancel_point.h"
#include "common/number_text.h"
#include "common/parallel_for.h"
#include "common/progress_counter.h"
#include "field/empty_sphere_search.h"
#include "field/grid_cell.h"
#include "field/spread_order.h"

namespace sdf_ccd {
namespace {

class AdaptiveBuilder {
 public:
  AdaptiveBuilder(const Solid& solid, const AdaptiveShape& shape, std::size_t max_bytes)
      : surface_(solid),
        shape_(shape),
        error_(shape.error_bound),
        capped_error_(std::max(error_, unprovedError(shape))),
        max_bytes_(max_bytes),
        blocks_(surface_, shape_) {}

  AdaptiveGrid build(const Progress& progress);

 private:
  class BlockSink;

  /// Leaves of the last depth that are not proved have the error bound of any 1-Lipschitz function [m].
  static double unprovedError(const AdaptiveShape& shape) {
    return kHalfSqrt3 * shape.unit() + AdaptiveGrid::leafScaleFor(shape.unit(), shape.band).rounding();
  }

  /// @throws std::length_error beyond the limit of bytes.
  void count(std::size_t bytes);
  void buildBlocks(const Progress& progress);
  /// Sets the words of all top cells; those of cells near the surface are replaced later.
  void setEmptySpheres();
  void reserve();
  /// Moves the cells of all blocks to data_, in the order of top cells.
  void join();
  void append(const BuiltCells& cells, std::size_t top);

  SurfaceIndex surface_;
  AdaptiveShape shape_;
  double error_, capped_error_;  ///< bounds if all leaves are proved, and if some are not [m]
  std::size_t max_bytes_;
  BlockBuilder blocks_;
  std::vector<float> centers_;                            ///< distances at the top cells' centres [top cells]
  std::vector<std::unique_ptr<const BuiltCells>> built_;  ///< by block; null if it is far
  const CancelPoint cancel_;
  std::atomic<std::size_t> bytes_{0}, done_{0};  ///< done_: blocks
  AdaptiveData data_;
  std::size_t leaf_count_ = 0;  ///< without those of splits
};

/// Receives the cells of one block.
class AdaptiveBuilder::BlockSink : public CellSink {
 public:
  explicit BlockSink(AdaptiveBuilder& builder) : builder_(builder), writer_(builder.shape_, builder.capped_error_) {}

  void count(std::size_t bytes) override { builder_.count(bytes); }
  void addDistance(std::size_t index, double distance) override {
    builder_.centers_[index] = static_cast<float>(distance / builder_.shape_.cell);
  }
  void add(std::size_t index, BuiltCell&& cell) override { writer_.add(index, std::move(cell)); }

  std::unique_ptr<const BuiltCells> finish() { return writer_.finish(); }

 private:
  AdaptiveBuilder& builder_;
  CellWriter writer_;
};

void AdaptiveBuilder::count(std::size_t bytes) {
  if ((bytes_ += bytes) <= max_bytes_) return;
  std::string message = "field: a maximum error of " + numberText(error_) + " m needs more than the limit of " +
                        std::to_string(max_bytes_ >> 20) + " MB";
  // The blocks that are done are a fair sample, and cells of a curved surface are in inverse proportion to the error.
  constexpr double kMargin = 1.2;
  const double times = kMargin * double(blocks_.count()) / double(done_);
  if (done_ > 0) message += "; about " + shortText(times * error_) + " m would fit";
  throw std::length_error(message);
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
  built_.resize(nearest.size());
  parallelFor(std::size_t{0}, nearest.size(), [&](std::size_t k) {
    const std::size_t i = order[k];
    BlockSink sink(*this);
    blocks_.build(blocks_.block(i), nearest[i], sink);
    built_[i] = sink.finish();
    ++done_;
    counter.add();
  });
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

void AdaptiveBuilder::reserve() {
  std::size_t nodes = 0, splits = 0;
  for (const auto& cells : built_) {
    if (!cells) continue;
    nodes += cells->nodes.size();
    leaf_count_ += cells->leaves.size();
    splits += cells->splits.size();
  }
  data_.nodes.reserve(nodes);
  data_.bases.reserve(nodes);
  data_.leaves.reserve(leaf_count_);
  data_.splits.reserve(splits);
  data_.leaf_errors.resize(leaf_count_ + 8 * splits);
}

void AdaptiveBuilder::append(const BuiltCells& cells, std::size_t top) {
  const auto [index, first] = cells.tops[top];
  const NodeBases end = cells.end(top);
  const auto appendPart = [](auto& to, const auto& from, std::size_t first, std::size_t end) {
    to.insert(to.end(), from.begin() + std::ptrdiff_t(first), from.begin() + std::ptrdiff_t(end));
  };
  const NodeBases at{static_cast<std::uint32_t>(data_.leaves.size()), static_cast<std::uint32_t>(data_.splits.size()),
                     static_cast<std::uint32_t>(data_.nodes.size())};
  std::uint32_t& word = data_.top[index];
  if (end.node > first.node) {
    word = at.node << 2 | top_word::kNode;
  } else {
    word = end.split > first.split ? at.split << 2 | top_word::kSplit : at.leaf << 2 | top_word::kLeaf;
  }
  const auto code = [&](const BuiltCells::ErrorCodes& codes) { return blocks_.capped() ? codes.capped : codes.proved; };
  const auto errors = data_.leaf_errors.begin();
  std::transform(cells.leaf_errors.begin() + first.leaf, cells.leaf_errors.begin() + end.leaf, errors + at.leaf, code);
  std::transform(cells.split_errors.begin() + 8 * std::ptrdiff_t(first.split),
                 cells.split_errors.begin() + 8 * std::ptrdiff_t(end.split),
                 errors + std::ptrdiff_t(leaf_count_ + 8 * std::size_t(at.split)), code);
  for (std::size_t i = first.node; i < end.node; ++i) {
    const NodeBases& bases = cells.bases[i];
    data_.bases.push_back({at.leaf + (bases.leaf - first.leaf), at.split + (bases.split - first.split),
                           at.node + (bases.node - first.node)});
  }
  appendPart(data_.nodes, cells.nodes, first.node, end.node);
  appendPart(data_.leaves, cells.leaves, first.leaf, end.leaf);
  appendPart(data_.splits, cells.splits, first.split, end.split);
}

void AdaptiveBuilder::join() {
  reserve();
  const Vector3i& size = shape_.size;
  const Vector3i blocks = blocks_.blocks();
  std::vector<std::uint8_t> done(built_.size(), 0);  // top cells of each block
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y) {
      cancel_.check();
      const std::size_t row =
          (std::size_t(z / BlockBuilder::kSide) * blocks.y() + y / BlockBuilder::kSide) * blocks.x();
      const std::size_t last = (std::size_t(z) * size.y() + y + 1) * size.x() - 1;
      for (std::size_t i = row; i < row + blocks.x(); ++i) {
        if (!built_[i]) continue;
        const BuiltCells& cells = *built_[i];
        for (; done[i] < cells.order.size() && cells.tops[cells.order[done[i]]].index <= last; ++done[i])
          append(cells, cells.order[done[i]]);
        if (done[i] == cells.order.size()) built_[i].reset();
      }
    }
}

AdaptiveGrid AdaptiveBuilder::build(const Progress& progress) {
  count(shape_.count() * sizeof(std::uint32_t));
  centers_.resize(shape_.count());
  buildBlocks(progress);
  if (blocks_.capped()) shape_.error_bound = capped_error_;
  setEmptySpheres();
  centers_ = {};
  join();
  return {shape_, std::move(data_)};
}

}  // namespace

std::shared_ptr<const AdaptiveGrid> buildAdaptive(const Solid& solid, const FieldOptions& options,
                                                  const Progress& progress) {
  const AdaptiveShape shape = adaptiveShape(boundingBox(solid.boundary()), options);
  return std::make_shared<const AdaptiveGrid>(AdaptiveBuilder(solid, shape, options.max_bytes).build(progress));
}

}  // namespace sdf_ccd
