#include "block_builder.h"

#include <algorithm>

#include "field/uniform/sparse_grid.h"

namespace sdf_ccd {

/// The proved leaves of a cell's octants; only the first `tried` octants were tried.
struct BlockBuilder::OctantLeaves {
  std::array<std::optional<FittedLeaf>, 8> leaf;
  int tried = 0;
};

void BlockBuilder::build(const Vector3i& block, const SignedSurface::Nearest& at_center, CellSink& sink) const {
  const Block cells{kSide * block, kSide};
  const SpaceCube cube{center(cells), side()};
  if (isFar(at_center.distance, cube.side)) return measureFar(cells, at_center, sink);
  const NearCube near(surface_, cube, at_center);
  buildNear(cells, near.near(), sink);
}

void BlockBuilder::measureFar(const Block& block, SignedSurface::Nearest last, CellSink& sink) const {
  Vector3d last_point = center(block);
  for (int i = 0; i < block.side * block.side * block.side; ++i) {
    // Back and forth, so that each cell is adjacent to the last one.
    const int row = i / block.side, layer = row / block.side, x = i % block.side, y = row % block.side;
    const auto flipped = [&](int k, int flips) { return flips % 2 == 0 ? k : block.side - 1 - k; };
    const Vector3i cell = block.low + Vector3i(flipped(x, row), flipped(y, layer), layer);
    if (!withinGrid(cell)) continue;
    const Vector3d point = center(Block{cell, 1});
    last = surface_.exact().next(point, last, (point - last_point).norm());
    last_point = point;
    sink.addDistance(index(cell), last.distance);
  }
}

void BlockBuilder::buildNear(const Block& block, const NearTriangles& near, CellSink& sink) const {
  NearOctants octants(near);
  for (int k = 0; k < 8; ++k) {
    const Block part = block.octant(k);
    if (!withinGrid(part.low)) continue;
    const bool far = isFar(octants.centerDistance(k), part.side * shape_.cell);
    if (part.side > 1 && far) {
      measureFar(part, octants.nearest(k), sink);
    } else if (part.side > 1) {
      buildNear(part, octants[k], sink);
    } else {
      sink.addDistance(index(part.low), octants.centerDistance(k));
      if (far) continue;
      CellFit fit(octants[k]);
      sink.add(index(part.low), cell(fit, octants[k], 0, sink));
    }
  }
}

bool BlockBuilder::provedFar(const LeafScale& scale, LeafWord leaf, double center_distance) const {
  const double beyond = shape_.band + error_;
  const std::array<double, 8> corners = scale.decode(leaf);
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
  return center_distance > 0.0 ? *low > beyond : *high < -beyond;
}

bool BlockBuilder::holdsFar(double center_distance, int depth) const {
  if (depth == 0) return true;
  const double parent = shape_.cell / double(1 << (2 * depth - 2));
  return node_code::steps(node_code::far(center_distance / AdaptiveGrid::farStepFor(parent, shape_.band))) != 0.0;
}

BuiltCell BlockBuilder::cell(CellFit& fit, const NearTriangles& near, int depth, CellSink& sink) const {
  cancel_.check();
  const double side = near.cube().side;
  BuiltCell built;
  built.distance = near.centerDistance();
  const LeafScale scale = AdaptiveGrid::leafScaleFor(side, shape_.band);
  if (const auto leaf = fit.leaf(scale, error_)) {
    if (provedFar(scale, leaf->word, built.distance) && holdsFar(built.distance, depth)) return built;
    built.kind = BuiltCell::kLeaf;
    built.leaf = *leaf;
    sink.count(sizeof(LeafWord) + sizeof(std::uint8_t));
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
  if (!fits && !last) return divide(fit, near, depth, octants, sink);
  std::array<FittedLeaf, 8> split;
  for (int k = 0; k < 8; ++k) split[k] = octants.leaf[k] ? *octants.leaf[k] : fit.roundedLeaf(k, half_scale);
  const auto far = [&](const FittedLeaf& leaf) { return provedFar(half_scale, leaf.word, built.distance); };
  if (fits && std::all_of(split.begin(), split.end(), far) && holdsFar(built.distance, depth)) return built;
  if (!fits) capped_ = true;
  built.kind = BuiltCell::kSplit;
  built.split = std::make_unique<std::array<FittedLeaf, 8>>(split);
  sink.count(sizeof(SplitLeaves) + 8 * sizeof(std::uint8_t));
  return built;
}

BuiltCell BlockBuilder::divide(CellFit& fit, const NearTriangles& near, int depth, OctantLeaves& octants,
                               CellSink& sink) const {
  BuiltCell built;
  built.kind = BuiltCell::kNode;
  built.children = std::make_unique<std::array<BuiltCell, 64>>();
  const double half_side = 0.5 * near.cube().side, child_side = 0.5 * half_side;
  const LeafScale half_scale = AdaptiveGrid::leafScaleFor(half_side, shape_.band);
  for (int half = 0; half < 8; ++half) {
    const double distance = fit.octants().centerDistance(half);
    std::optional<FittedLeaf>& leaf = octants.leaf[half];
    if (half >= octants.tried && !isFar(distance, half_side)) leaf = fit.octantLeaf(half, half_scale, error_);
    const bool far = leaf && provedFar(half_scale, leaf->word, distance);
    if (leaf && !far) {
      sink.count(sizeof(LeafWord) + sizeof(std::uint8_t));
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
      child = cell(child_fit, child_near, depth + 1, sink);
    }
  }
  const auto far = [&](const BuiltCell& child) {
    return child.kind == BuiltCell::kFar && (child.distance < 0.0) == (near.centerDistance() < 0.0);
  };
  if (std::all_of(built.children->begin(), built.children->end(), far) && holdsFar(near.centerDistance(), depth)) {
    built.kind = BuiltCell::kFar;
    built.distance = near.centerDistance();
    built.children.reset();
  } else {
    sink.count(sizeof(AdaptiveNode) + sizeof(NodeBases));
  }
  return built;
}

}  // namespace sdf_ccd
