#include "build_adaptive.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>

#include <tbb/parallel_for.h>

#include "cell_fit.h"
#include "near_triangles.h"
#include "progress_counter.h"
#include "sdf_ccd/field/sparse_grid.h"

namespace sdf_ccd {
namespace {

/// What stands in a cell's place.
struct BuiltCell {
  enum Kind { kFar, kLeaf, kSplit, kNode } kind = kFar;
  double distance = 0.0;  ///< far: at the centre
  LeafWord leaf = 0;
  SplitLeaves split{};
  std::unique_ptr<std::array<BuiltCell, 64>> children;
};

class AdaptiveBuilder {
 public:
  AdaptiveBuilder(const TriangleMesh& mesh, const AdaptiveShape& shape, const FieldOptions& options)
      : surface_(mesh), shape_(shape), error_(shape.error_bound), max_bytes_(options.max_bytes) {}

  AdaptiveGrid build(const Progress& progress);

 private:
  Vector3d topCenter(const Vector3i& i) const {
    return shape_.origin + shape_.cell * (i.cast<double>().array() + 0.5).matrix();
  }
  void measureCenters();
  BuiltCell cell(const NearTriangles& near, CellFit& fit, const Vector3d& low, int depth);
  /// Whether a proved leaf shows that |φ| exceeds the band all over it, on the side that its cell's centre is on.
  bool provedFar(const LeafScale& scale, LeafWord leaf, double center_distance) const;
  /// Whether a far cell at this depth can tell its side: the rounded distance of its centre is not zero.
  bool holdsFar(double center_distance, int depth) const;
  BuiltCell divide(const NearTriangles& near, CellFit& fit, const Vector3d& low, int depth);
  void count(std::size_t bytes);
  void flatten(const BuiltCell& cell, std::size_t node, int depth);

  SurfaceIndex surface_;
  AdaptiveShape shape_;
  double error_;
  std::size_t max_bytes_;
  std::vector<double> centers_;  ///< signed distances at the top cells' centres [m]
  std::atomic<std::size_t> bytes_{0};
  std::atomic<bool> capped_{false};  ///< a leaf at the last depth is not proved
  AdaptiveData data_;
};

void AdaptiveBuilder::count(std::size_t bytes) {
  if ((bytes_ += bytes) > max_bytes_) {
    throw std::length_error("field: a maximum error of " + std::to_string(error_) + " m needs more than the " +
                            std::to_string(max_bytes_ >> 20) + " MB allowed; allow a larger error");
  }
}

void AdaptiveBuilder::measureCenters() {
  centers_.resize(shape_.count());
  const SignedSurface& exact = surface_.exact();
  tbb::parallel_for(0, shape_.size.z(), [&](int z) {
    for (int y = 0; y < shape_.size.y(); ++y) {
      SignedSurface::Nearest last{};
      for (int x = 0; x < shape_.size.x(); ++x) {
        const Vector3d p = topCenter({x, y, z});
        last = x == 0 ? exact.nearest(p) : exact.next(p, last, shape_.cell);
        centers_[(std::size_t(z) * shape_.size.y() + y) * shape_.size.x() + x] = last.distance;
      }
    }
  });
}

bool AdaptiveBuilder::provedFar(const LeafScale& scale, LeafWord leaf, double center_distance) const {
  const double beyond = shape_.band + error_;
  const std::array<double, 8> corners = scale.decode(leaf);
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
  return center_distance > 0.0 ? *low > beyond : *high < -beyond;
}

bool AdaptiveBuilder::holdsFar(double center_distance, int depth) const {
  if (depth == 0) return center_distance != 0.0;
  const double parent = shape_.cell / double(1 << (2 * depth - 2));
  return node_code::steps(node_code::far(center_distance / AdaptiveGrid::farStepFor(parent, shape_.band))) != 0.0;
}

BuiltCell AdaptiveBuilder::cell(const NearTriangles& near, CellFit& fit, const Vector3d& low, int depth) {
  const double side = shape_.cell / double(1 << (2 * depth));
  BuiltCell built;
  built.distance = near.centerDistance();
  const LeafScale scale = AdaptiveGrid::leafScaleFor(side, shape_.band);
  if (fit.leaf({Vector3i::Zero(), CellFit::kSteps}, scale, error_, built.leaf)) {
    if (provedFar(scale, built.leaf, built.distance) && holdsFar(built.distance, depth)) return built;
    built.kind = BuiltCell::kLeaf;
    count(sizeof(LeafWord));
    return built;
  }
  const LeafScale half_scale = AdaptiveGrid::leafScaleFor(0.5 * side, shape_.band);
  const bool last = depth == AdaptiveShape::kMaxDepth;
  bool fits = true;
  for (int k = 0; k < 8 && (fits || last); ++k) {
    const CellFit::Cube cube{CellFit::kSteps / 2 * Vector3i(k & 1, (k >> 1) & 1, k >> 2), CellFit::kSteps / 2};
    fits = fit.leaf(cube, half_scale, error_, built.split.leaves[k]) && fits;
    if (last && !fits) built.split.leaves[k] = fit.roundedLeaf(cube, half_scale);
  }
  if (!fits && !last) return divide(near, fit, low, depth);
  const auto far = [&](LeafWord leaf) { return provedFar(half_scale, leaf, built.distance); };
  if (fits && std::all_of(built.split.leaves.begin(), built.split.leaves.end(), far) &&
      holdsFar(built.distance, depth)) {
    return built;
  }
  if (!fits) capped_ = true;
  built.kind = BuiltCell::kSplit;
  count(sizeof(SplitLeaves));
  return built;
}

BuiltCell AdaptiveBuilder::divide(const NearTriangles& near, CellFit& fit, const Vector3d& low, int depth) {
  BuiltCell built;
  built.kind = BuiltCell::kNode;
  built.children = std::make_unique<std::array<BuiltCell, 64>>();
  count(sizeof(AdaptiveNode) + sizeof(NodeBases));
  const double side = shape_.cell / double(1 << (2 * depth + 2)), radius = kHalfSqrt3 * side;
  for (int i = 0; i < 64; ++i) {
    const Vector3i c(i & 3, (i >> 2) & 3, i >> 4);
    const Vector3d child_low = low + side * c.cast<double>();
    const Vector3d center = child_low.array() + 0.5 * side;
    const double distance = near.signedDistance(center);
    BuiltCell& child = (*built.children)[i];
    if (std::abs(distance) > shape_.band + radius * (1.0 + 1e-9)) {
      child.distance = distance;
      continue;
    }
    const NearTriangles child_near(near, {center, radius}, distance);
    CellFit child_fit(child_near, child_low, side);
    for (int k = 0; k < 8; ++k) {
      const Vector3i corner(k & 1, (k >> 1) & 1, k >> 2);
      child_fit.set(CellFit::kSteps * corner, fit.at(CellFit::kSteps / 4 * (c + corner)));
    }
    child_fit.set(Vector3i::Constant(CellFit::kSteps / 2), distance);
    child = cell(child_near, child_fit, child_low, depth + 1);
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

void AdaptiveBuilder::flatten(const BuiltCell& cell, std::size_t node, int depth) {
  NodeBases& bases = data_.bases[node];
  bases = {static_cast<std::uint32_t>(data_.leaves.size()), static_cast<std::uint32_t>(data_.splits.size()),
           static_cast<std::uint32_t>(data_.nodes.size())};
  const double step = AdaptiveGrid::farStepFor(shape_.cell / double(1 << (2 * depth)), shape_.band);
  int leaves = node_code::kLeaf, splits = node_code::kSplit, nodes = node_code::kNode;
  for (int i = 0; i < 64; ++i) {
    const BuiltCell& child = (*cell.children)[i];
    int code = 0;
    switch (child.kind) {
      case BuiltCell::kFar:
        code = node_code::far(child.distance / step);
        break;
      case BuiltCell::kLeaf:
        data_.leaves.push_back(child.leaf);
        code = leaves++;
        break;
      case BuiltCell::kSplit:
        data_.splits.push_back(child.split);
        code = splits++;
        break;
      case BuiltCell::kNode:
        code = nodes++;
        break;
    }
    data_.nodes[node].codes[i] = static_cast<std::uint8_t>(code);
  }
  std::size_t next = bases.node;
  data_.nodes.resize(data_.nodes.size() + (nodes - node_code::kNode));
  data_.bases.resize(data_.nodes.size());
  for (const BuiltCell& child : *cell.children) {
    if (child.kind == BuiltCell::kNode) flatten(child, next++, depth + 1);
  }
}

AdaptiveGrid AdaptiveBuilder::build(const Progress& progress) {
  count(shape_.count() * sizeof(std::uint32_t));
  measureCenters();
  const double radius = kHalfSqrt3 * shape_.cell;
  std::vector<std::size_t> near_cells;
  data_.top.resize(shape_.count());
  for (std::size_t i = 0; i < centers_.size(); ++i) {
    data_.top[i] = top_word::far(centers_[i]);
    if (std::abs(centers_[i]) <= shape_.band + radius * (1.0 + 1e-9)) near_cells.push_back(i);
  }

  std::vector<BuiltCell> built(near_cells.size());
  ProgressCounter counter(progress, near_cells.size());
  tbb::parallel_for(std::size_t{0}, near_cells.size(), [&](std::size_t i) {
    const std::size_t cell_index = near_cells[i];
    const auto nx = std::size_t(shape_.size.x()), ny = std::size_t(shape_.size.y());
    const Vector3i c(int(cell_index % nx), int(cell_index / nx % ny), int(cell_index / nx / ny));
    const Vector3d low = shape_.origin + shape_.cell * c.cast<double>();
    const NearTriangles near(surface_, {topCenter(c), radius}, centers_[cell_index]);
    CellFit fit(near, low, shape_.cell);
    fit.set(Vector3i::Constant(CellFit::kSteps / 2), centers_[cell_index]);
    built[i] = cell(near, fit, low, 0);
    counter.add();
  });

  for (std::size_t i = 0; i < built.size(); ++i) {
    std::uint32_t& word = data_.top[near_cells[i]];
    switch (built[i].kind) {
      case BuiltCell::kFar:
        break;
      case BuiltCell::kLeaf:
        word = static_cast<std::uint32_t>(data_.leaves.size() << 2) | top_word::kLeaf;
        data_.leaves.push_back(built[i].leaf);
        break;
      case BuiltCell::kSplit:
        word = static_cast<std::uint32_t>(data_.splits.size() << 2) | top_word::kSplit;
        data_.splits.push_back(built[i].split);
        break;
      case BuiltCell::kNode:
        word = static_cast<std::uint32_t>(data_.nodes.size() << 2) | top_word::kNode;
        data_.nodes.emplace_back();
        data_.bases.emplace_back();
        flatten(built[i], data_.nodes.size() - 1, 0);
        built[i].children.reset();
        break;
    }
  }
  if (capped_) {
    // Leaves of the last depth that are not proved: what holds for any 1-Lipschitz function.
    const double side = shape_.unit();
    shape_.error_bound = std::max(error_, kHalfSqrt3 * side + AdaptiveGrid::leafScaleFor(side, shape_.band).rounding());
  }
  return {shape_, std::move(data_)};
}

/// Top cells along the longest side. More of them shorten a query's way through far cells and lie denser than the
/// surface needs; measured on scans, memory stays within a quarter of the least that any number gives.
int topCells(double relative_error) {
  return static_cast<int>(std::clamp(std::round(1.3 / std::sqrt(relative_error)), 8.0, 96.0));
}

}  // namespace

std::shared_ptr<const AdaptiveGrid> buildAdaptive(const TriangleMesh& mesh, const FieldOptions& options,
                                                  const Progress& progress) {
  AdaptiveShape shape;
  shape.surface_box = boundingBox(mesh);
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
  return std::make_shared<const AdaptiveGrid>(AdaptiveBuilder(mesh, shape, options).build(progress));
}

}  // namespace sdf_ccd
