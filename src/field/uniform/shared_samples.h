#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/lattice.h"
#include "field/uniform/brick_sampler.h"
#include "field/uniform/sparse_grid.h"

namespace sdf_ccd {

/// Samples on a brick's faces, edges and corners, which neighbouring bricks have too: the last of them that has samples
/// computes each, and the others copy it.
class SharedSamples {
 public:
  /// @param slots  of all bricks, increasing with the brick's index; kFar for those without samples.
  SharedSamples(const GridShape& shape, const std::vector<std::int32_t>& slots, const Vector3i& brick)
      : own_(slots[shape.brickIndex(brick)]) {
    const Vector3i one = Vector3i::Ones();
    forEachPoint(parts(), [&](const Vector3i& part) {
      Owner& owner = owners_[indexIn(parts(), part)];
      const Vector3i toward = part - one;
      forEachPoint(toward.cwiseMin(0), toward.cwiseMax(0) + one, [&](const Vector3i& offset) {
        const Vector3i other = brick + offset;
        if ((other.array() < 0).any() || (other.array() >= shape.bricks.array()).any()) return;
        if (slots[shape.brickIndex(other)] > owner.slot) owner = {slots[shape.brickIndex(other)], offset};
      });
    });
  }

  /// Those that the brick itself computes.
  BrickSampler::Wanted own() const {
    BrickSampler::Wanted own;
    own.set();
    forEachOfOthers(
        [&](const Owner&, const Vector3i& local) { own.reset(std::size_t(GridShape::sampleIndex(local))); });
    return own;
  }

  /// Copies the samples of other bricks, once these have computed them.
  void copy(std::vector<std::int16_t>& samples) const {
    const auto at = [&](std::int32_t slot, const Vector3i& local) -> std::int16_t& {
      return samples[GridShape::sampleIndex(slot, local)];
    };
    forEachOfOthers([&](const Owner& owner, const Vector3i& local) {
      at(own_, local) = at(owner.slot, local - GridShape::kBrick * owner.offset);
    });
  }

 private:
  struct Owner {
    std::int32_t slot = SparseGrid::kFar;
    Vector3i offset = Vector3i::Zero();  ///< from the brick to the owner [bricks]
  };

  template <class Visit>
  void forEachOfOthers(const Visit& visit) const {
    constexpr std::array<int, 4> kBegin = {0, 1, GridShape::kBrick, GridShape::kSide};
    forEachPoint(parts(), [&](const Vector3i& part) {
      const Owner& owner = owners_[indexIn(parts(), part)];
      if (owner.slot == own_) return;
      const Vector3i begin(kBegin[part.x()], kBegin[part.y()], kBegin[part.z()]);
      const Vector3i end(kBegin[part.x() + 1], kBegin[part.y() + 1], kBegin[part.z() + 1]);
      forEachPoint(begin, end, [&](const Vector3i& local) { visit(owner, local); });
    });
  }

  /// Per axis: the samples on the lower face, those between, and those on the upper face.
  static Vector3i parts() { return Vector3i::Constant(3); }

  std::int32_t own_;
  std::array<Owner, 27> owners_;  ///< of the parts
};

}  // namespace sdf_ccd
