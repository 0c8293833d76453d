#include "build_adaptive.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include <tbb/concurrent_vector.h>

#include "cell_fit.h"
#include "cube_corner.h"
#include "far_ball_search.h"
#include "near_triangles.h"
#include "progress_counter.h"
#include "sdf_ccd/field/sparse_grid.h"
#include "sdf_ccd/geometry/parallel_for.h"

namespace sdf_ccd {
namespace {

/// What stands in a cell's place.
struct BuiltCell {
  enum Kind { kFar, kLeaf, kWide, kSplit, kNode } kind = kFar;
  double distance = 0.0;  ///< far: at the centre
  FittedLeaf leaf;        ///< wide: of the octant that the cell is one eighth of
  std::array<FittedLeaf, 8> split;
  std::unique_ptr<std::array<BuiltCell, 64>> children;
};

/// Leaves in the places of a cell's octants, where they are proved; the first ones that were tried.
struct OctantLeaves {
  std::array<std::optional<FittedLeaf>, 8> leaf;
  int tried = 0;
};

/// In a node, of the k-th cell in an octant.
int childIndex(int octant, int k) {
  const Vector3i c = 2 * cubeCorner(octant) + cubeCorner(k);
  return c.x() + 4 * (c.y() + 4 * c.z());
}

class AdaptiveBuilder {
 public:
  AdaptiveBuilder(const Solid& solid, const AdaptiveShape& shape, std::size_t max_bytes, const Progress& progress)
      : surface_(solid),
        shape_(shape),
        error_(shape.error_bound),
        max_bytes_(max_bytes),
        counter_(progress, shape.count()) {}

  AdaptiveGrid build();

 private:
  /// A cube of top cells: first cell and side, in cells. The last ones may end beyond the grid.
  struct Block {
    Vector3i low;
    int side;

    Block octant(int k) const { return {low + side / 2 * cubeCorner(k), side / 2}; }
  };
  Vector3d center(const Block& block) const {
    return shape_.origin + shape_.cell * (block.low.cast<double>().array() + 0.5 * block.side).matrix();
  }
  bool withinGrid(const Vector3i& cell) const { return (cell.array() < shape_.size.array()).all(); }
  std::size_t index(const Vector3i& cell) const {
    return (std::size_t(cell.z()) * shape_.size.y() + cell.y()) * shape_.size.x() + cell.x();
  }
  /// Whether |φ| > band in all of a cube of this side.
  bool isFar(double center_distance, double side) const {
    return std::abs(center_distance) > shape_.band + kHalfSqrt3 * side * (1.0 + 1e-9);
  }

  /// Measures a block's cells, and builds those that are near the surface.
  void measure(const Block& block, const SignedSurface::Nearest& at_center);
  void measureNear(const Block& block, const NearTriangles& near);
  /// Cells that are all far: one by one, each starting from what the last one found.
  void measureFar(const Block& block, SignedSurface::Nearest last);
  BuiltCell cell(CellFit& fit, const NearTriangles& near, int depth);
  /// Whether a proved leaf shows that |φ| exceeds the band all over it, on the side that its cell's centre is on.
  bool provedFar(const LeafScale& scale, LeafWord leaf, double center_distance) const;
  /// Whether a far cell at this depth can tell its side: the rounded distance of its centre is not zero.
  bool holdsFar(double center_distance, int depth) const;
  /// For all top cells; those near the surface get other words.
  void setFarBalls();
  BuiltCell divide(CellFit& fit, const NearTriangles& near, int depth, OctantLeaves& octants);
  void count(std::size_t bytes);
  void flatten(const BuiltCell& cell, std::size_t node, int depth);
  void addLeaf(const FittedLeaf& leaf);
  void addSplit(const std::array<FittedLeaf, 8>& split);

  SurfaceIndex surface_;
  AdaptiveShape shape_;
  double error_;
  std::size_t max_bytes_;
  std::vector<float> centers_;  ///< distances at the top cells' centres [top cells]
  tbb::concurrent_vector<std::pair<std::size_t, BuiltCell>> built_;  ///< top cells near the surface, in no order
  ProgressCounter counter_;
  const CancelPoint cancel_;
  std::atomic<std::size_t> bytes_{0};
  std::atomic<bool> capped_{false};  ///< a leaf at the last depth is not proved
  AdaptiveData data_;
  std::vector<std::uint8_t> split_errors_;  ///< those of the splits' leaves; in the data they follow the others
};

void AdaptiveBuilder::count(std::size_t bytes) {
  if ((bytes_ += bytes) > max_bytes_) {
    throw std::length_error("field: a maximum error of " + std::to_string(error_) + " m needs more than the " +
                            std::to_string(max_bytes_ >> 20) + " MB allowed; allow a larger error");
  }
}

void AdaptiveBuilder::measure(const Block& block, const SignedSurface::Nearest& at_center) {
  const SpaceCube cube{center(block), block.side * shape_.cell};
  if (isFar(at_center.distance, cube.side)) return measureFar(block, at_center);
  const NearCube near(surface_, cube, at_center);
  measureNear(block, near.near());
}

void AdaptiveBuilder::measureFar(const Block& block, SignedSurface::Nearest last) {
  Vector3d last_place = center(block);
  for (int i = 0; i < block.side * block.side * block.side; ++i) {
    // To and fro, so that each cell is next to the last one.
    const int row = i / block.side, layer = row / block.side, x = i % block.side, y = row % block.side;
    const auto turned = [&](int k, int turns) { return turns % 2 == 0 ? k : block.side - 1 - k; };
    const Vector3i cell = block.low + Vector3i(turned(x, row), turned(y, layer), layer);
    if (!withinGrid(cell)) continue;
    const Vector3d place = center({cell, 1});
    last = surface_.exact().next(place, last, (place - last_place).norm());
    last_place = place;
    centers_[index(cell)] = static_cast<float>(last.distance / shape_.cell);
    counter_.add();
  }
}

void AdaptiveBuilder::measureNear(const Block& block, const NearTriangles& near) {
  NearOctants octants(near);
  for (int k = 0; k < 8; ++k) {
    const Block part = block.octant(k);
    if (!withinGrid(part.low)) continue;
    const bool far = isFar(octants.centerDistance(k), part.side * shape_.cell);
    if (part.side > 1 && far) {
      measureFar(part, octants.nearest(k));
    } else if (part.side > 1) {
      measureNear(part, octants[k]);
    } else {
      const std::size_t cell_index = index(part.low);
      centers_[cell_index] = static_cast<float>(octants.centerDistance(k) / shape_.cell);
      if (!far) {
        CellFit fit(octants[k]);
        built_.emplace_back(cell_index, cell(fit, octants[k], 0));
      }
      counter_.add();
    }
  }
}

bool AdaptiveBuilder::provedFar(const LeafScale& scale, LeafWord leaf, double center_distance) const {
  const double beyond = shape_.band + error_;
  const std::array<double, 8> corners = scale.decode(leaf);
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
  return center_distance > 0.0 ? *low > beyond : *high < -beyond;
}

bool AdaptiveBuilder::holdsFar(double center_distance, int depth) const {
  if (depth == 0) return true;
  const double parent = shape_.cell / double(1 << (2 * depth - 2));
  return node_code::steps(node_code::far(center_distance / AdaptiveGrid::farStepFor(parent, shape_.band))) != 0.0;
}

BuiltCell AdaptiveBuilder::cell(CellFit& fit, const NearTriangles& near, int depth) {
  cancel_.check();
  const double side = near.cube().side;
  BuiltCell built;
  built.distance = near.centerDistance();
  const LeafScale scale = AdaptiveGrid::leafScaleFor(side, shape_.band);
  if (const auto leaf = fit.leaf(scale, error_)) {
    if (provedFar(scale, leaf->word, built.distance) && holdsFar(built.distance, depth)) return built;
    built.kind = BuiltCell::kLeaf;
    built.leaf = *leaf;
    count(sizeof(LeafWord) + sizeof(std::uint8_t));
    return built;
  }
  const LeafScale half_scale = AdaptiveGrid::leafScaleFor(0.5 * side, shape_.band);
  const bool last = depth == AdaptiveShape::kMaxDepth;
  bool fits = true;
  OctantLeaves octants;
  for (int& k = octants.tried; k < 8 && (fits || last); ++k) {
    octants.leaf[k] = fit.octantLeaf(k, half_scale, error_);
    fits = fits && octants.leaf[k];
  }
  if (!fits && !last) return divide(fit, near, depth, octants);
  for (int k = 0; k < 8; ++k) built.split[k] = octants.leaf[k] ? *octants.leaf[k] : fit.roundedLeaf(k, half_scale);
  const auto far = [&](const FittedLeaf& leaf) { return provedFar(half_scale, leaf.word, built.distance); };
  if (fits && std::all_of(built.split.begin(), built.split.end(), far) && holdsFar(built.distance, depth)) return built;
  if (!fits) capped_ = true;
  built.kind = BuiltCell::kSplit;
  count(sizeof(SplitLeaves) + 8 * sizeof(std::uint8_t));
  return built;
}

BuiltCell AdaptiveBuilder::divide(CellFit& fit, const NearTriangles& near, int depth, OctantLeaves& octants) {
  BuiltCell built;
  built.kind = BuiltCell::kNode;
  built.children = std::make_unique<std::array<BuiltCell, 64>>();
  count(sizeof(AdaptiveNode) + sizeof(NodeBases));
  const double half_side = 0.5 * near.cube().side, child_side = 0.5 * half_side;
  const LeafScale half_scale = AdaptiveGrid::leafScaleFor(half_side, shape_.band);
  for (int half = 0; half < 8; ++half) {
    const double distance = fit.octants().centerDistance(half);
    std::optional<FittedLeaf>& leaf = octants.leaf[half];
    if (half >= octants.tried && !isFar(distance, half_side)) leaf = fit.octantLeaf(half, half_scale, error_);
    const bool far = leaf && provedFar(half_scale, leaf->word, distance);
    if (leaf && !far) {
      count(sizeof(LeafWord) + sizeof(std::uint8_t));
      for (int k = 0; k < 8; ++k) {
        BuiltCell& child = (*built.children)[childIndex(half, k)];
        child.kind = BuiltCell::kWide;
        child.leaf = *leaf;
      }
      continue;
    }
    NearOctants quarters(fit.octants()[half]);
    for (int k = 0; k < 8; ++k) {
      BuiltCell& child = (*built.children)[childIndex(half, k)];
      child.distance = quarters.centerDistance(k);
      if (isFar(child.distance, child_side) || (far && holdsFar(child.distance, depth + 1))) continue;
      const NearTriangles& child_near = quarters[k];
      CellFit child_fit(child_near, fit, 2 * cubeCorner(half) + cubeCorner(k));
      child = cell(child_fit, child_near, depth + 1);
    }
  }
  const auto far = [&](const BuiltCell& child) {
    return child.kind == BuiltCell::kFar && (child.distance < 0.0) == (near.centerDistance() < 0.0);
  };
  if (std::all_of(built.children->begin(), built.children->end(), far) && holdsFar(near.centerDistance(), depth)) {
    built.kind = BuiltCell::kFar;
    built.distance = near.centerDistance();
    built.children.reset();
  }
  return built;
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

void AdaptiveBuilder::setFarBalls() {
  data_.top.resize(shape_.count());
  const FarBallSearch search(FarBallSearch::Lattice::kCenters, shape_.size, centers_);
  parallelFor(0, shape_.size.z(), [&](int z) {
    std::size_t index = std::size_t(z) * shape_.size.x() * shape_.size.y();
    for (int y = 0; y < shape_.size.y(); ++y)
      for (int x = 0; x < shape_.size.x(); ++x) data_.top[index++] = search.ball({x, y, z}).word();
  });
}

AdaptiveGrid AdaptiveBuilder::build() {
  count(shape_.count() * sizeof(std::uint32_t));
  centers_.resize(shape_.count());
  // Blocks of so many cells along a side share a search for the triangles near them.
  constexpr int kBlock = 4;
  const Vector3i blocks = (shape_.size.array() + (kBlock - 1)) / kBlock;
  parallelFor(0, blocks.y() * blocks.z(), [&](int row) {
    const SignedSurface& exact = surface_.exact();
    SignedSurface::Nearest nearest{};
    for (int x = 0; x < blocks.x(); ++x) {
      const Block block{kBlock * Vector3i(x, row % blocks.y(), row / blocks.y()), kBlock};
      nearest = x == 0 ? exact.nearest(center(block)) : exact.next(center(block), nearest, kBlock * shape_.cell);
      measure(block, nearest);
    }
  });

  if (capped_) {
    // Leaves of the last depth that are not proved: what holds for any 1-Lipschitz function.
    const double side = shape_.unit();
    shape_.error_bound = std::max(error_, kHalfSqrt3 * side + AdaptiveGrid::leafScaleFor(side, shape_.band).rounding());
  }
  setFarBalls();
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

/// Top cells along the longest side. More of them shorten a query's way through far cells and spare it nodes; up to
/// these they cost less memory than that is worth (measured on scans and links).
int topCells(double relative_error) {
  return static_cast<int>(std::clamp(std::round(2.0 / std::sqrt(relative_error)), 8.0, 64.0));
}

}  // namespace

std::shared_ptr<const AdaptiveGrid> buildAdaptive(const Solid& solid, const FieldOptions& options,
                                                  const Progress& progress) {
  AdaptiveShape shape;
  shape.surface_box = boundingBox(solid.boundary());
  const double longest = shape.surface_box.sizes().maxCoeff();
  shape.error_bound = *options.max_error;
  shape.cell = longest / topCells(*options.max_error / longest);
  shape.band = std::max(options.band, 2.0 * *options.max_error);
  // Padded so that no place with |φ| ≤ band lies on the grid's boundary, where a query would miss what is beyond it.
  const double padding = 1.01 * shape.band + 0.01 * shape.cell;
  const Vector3d cells = ((shape.surface_box.sizes().array() + 2.0 * padding) / shape.cell).ceil();
  if (cells.maxCoeff() > 1024.0) {
    throw std::length_error("field: a band of " + std::to_string(shape.band) +
                            " m is too wide for a maximum error of " + std::to_string(*options.max_error) + " m");
  }
  shape.size = cells.cast<int>();
  shape.origin = shape.surface_box.center() - 0.5 * shape.cell * cells;
  return std::make_shared<const AdaptiveGrid>(AdaptiveBuilder(solid, shape, options.max_bytes, progress).build());
}

}  // namespace sdf_ccd
