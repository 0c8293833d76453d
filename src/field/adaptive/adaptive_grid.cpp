#include "field/adaptive/adaptive_grid.h"

#include <algorithm>

namespace sdf_ccd {

namespace leaf_error {

std::uint8_t code(double error, double error_bound) {
  // Slightly enlarged, so that the rounding here does not violate the bound.
  const double steps = 16.0 * std::log2(error_bound / (error * (1.0 + 1e-9)));
  return static_cast<std::uint8_t>(std::clamp(std::floor(steps), 0.0, 255.0));
}

double error(std::uint8_t code, double error_bound) {
  return error_bound * std::exp2(-code / 16.0);
}

}  // namespace leaf_error

LeafWord LeafScale::encode(const std::array<double, 8>& corners) const {
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
  const double middle = std::clamp(std::round(0.5 * (*low + *high) / offset), -127.0, 127.0);
  const double base = middle * offset - 63.5 * corner;
  const auto top_bits = static_cast<std::uint8_t>(static_cast<std::int8_t>(middle));
  LeafWord word = 0;
  for (int k = 0; k < 8; ++k) {
    const double steps = std::clamp(std::round((corners[k] - base) / corner), 0.0, 127.0);
    const auto byte = static_cast<LeafWord>(steps) | LeafWord((top_bits >> k) & 1) << 7;
    word |= byte << (8 * k);
  }
  return word;
}

AdaptiveGrid::AdaptiveGrid(const AdaptiveShape& shape, AdaptiveData data) : shape_(shape) {
  const auto owner = std::make_shared<const AdaptiveData>(std::move(data));
  arrays_ = {viewOf(owner->top),    viewOf(owner->nodes),  viewOf(owner->bases),
             viewOf(owner->leaves), viewOf(owner->splits), viewOf(owner->leaf_errors)};
  owner_ = owner;
  checkShape();
  checkTree();
  setScales();
}

AdaptiveGrid::AdaptiveGrid(const AdaptiveShape& shape, const Arrays& arrays, std::shared_ptr<const void> owner)
    : shape_(shape), arrays_(arrays), owner_(std::move(owner)) {
  checkShape();
  checkTree();
  setScales();
}

void AdaptiveGrid::setScales() {
  double side = shape_.cell;
  for (double& step : far_steps_) {
    step = farStepFor(side, shape_.band);
    side /= 4.0;
  }
  side = shape_.unit();
  for (LeafScale& scale : scales_) {
    scale = leafScaleFor(side, shape_.band);
    side *= 2.0;
  }
}

AdaptiveBlock AdaptiveGrid::farTopBlock(const Vector3i& low, const EmptySphere& ball) const {
  const double step = EmptySphere::step(shape_.size) * shape_.cell, radius = ball.steps * step;
  const double out = ball.offset.cast<double>().norm() * shape_.cell;
  const Vector3d center =
      (low + AdaptiveShape::kUnits * ball.offset).cast<double>().array() + 0.5 * AdaptiveShape::kUnits;
  // Rounding removed less than a step; the rest is the rounding of single precision.
  const double slack = (out > 0.0 ? EmptySphere::kSlack * shape_.cell : 0.0) + step + 1e-5 * radius;
  return {low, AdaptiveShape::kUnits, false, 0, 0, center, radius, ball.inside, radius - out + slack};
}

AdaptiveBlock AdaptiveGrid::block(const Vector3i& unit) const {
  // Sides are powers of two, so shifts and masks replace divisions, each of which costs as much as a cache miss.
  constexpr int kTop = 7;
  static_assert(1 << kTop == AdaptiveShape::kUnits, "a top cell's side");
  const int x = unit.x(), y = unit.y(), z = unit.z();
  const auto lowOf = [&](int shift) { return Vector3i(x >> shift << shift, y >> shift << shift, z >> shift << shift); };
  const auto leaf = [&](int shift, std::size_t i) {
    return AdaptiveBlock{lowOf(shift), 1 << shift, true, arrays_.leaves[i], i};
  };
  const auto half = [&](int shift, std::uint32_t split) {
    --shift;
    const int k = (x >> shift & 1) | (y >> shift & 1) << 1 | (z >> shift & 1) << 2;
    return AdaptiveBlock{lowOf(shift), 1 << shift, true, arrays_.splits[split].leaves[k],
                         arrays_.leaves.size + 8 * std::size_t(split) + k};
  };

  const std::uint32_t word =
      arrays_.top[(std::size_t(z >> kTop) * shape_.size.y() + (y >> kTop)) * shape_.size.x() + (x >> kTop)];
  std::uint32_t index = word >> 2;
  switch (word & top_word::kKind) {
    case top_word::kFar:
      return farTopBlock(lowOf(kTop), EmptySphere::of(word));
    case top_word::kLeaf:
      return leaf(kTop, index);
    case top_word::kSplit:
      return half(kTop, index);
    default:
      break;
  }
  for (int depth = 0, shift = kTop - 2;; ++depth, shift -= 2) {
    const int child = (x >> shift & 3) | (y >> shift & 3) << 2 | (z >> shift & 3) << 4;
    const std::uint8_t code = arrays_.nodes[index].codes[child];
    if (code >= node_code::kFar && code < node_code::kWide) {
      const double radius = std::abs(node_code::steps(code)) * far_steps_[depth];
      const Vector3i low = lowOf(shift);
      const Vector3d center = low.cast<double>().array() + 0.5 * (1 << shift);
      return {low, 1 << shift, false, 0, 0, center, radius, node_code::steps(code) < 0.0, radius + far_steps_[depth]};
    }
    const NodeBases& bases = arrays_.bases[index];
    if (code >= node_code::kWide) return leaf(shift + 1, std::size_t(bases.leaf) + (code - node_code::kWide));
    if (code < node_code::kNode) return leaf(shift, std::size_t(bases.leaf) + code);
    if (code >= node_code::kSplit) return half(shift, bases.split + (code - node_code::kSplit));
    index = bases.node + (code - node_code::kNode);
  }
}

std::size_t AdaptiveGrid::bytes() const {
  return arrays_.top.size * sizeof(std::uint32_t) + arrays_.nodes.size * (sizeof(AdaptiveNode) + sizeof(NodeBases)) +
         arrays_.leaves.size * sizeof(LeafWord) + arrays_.splits.size * sizeof(SplitLeaves) + arrays_.leaf_errors.size;
}

}  // namespace sdf_ccd
