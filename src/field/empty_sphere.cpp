#include "field/empty_sphere.h"

namespace sdf_ccd {
namespace {

// From the lowest bit: two bits for the cell's kind, five for each offset, fourteen for the radius, one for the side.
constexpr int kFirstOffset = 2, kOffsetBits = 5, kFirstStep = 17, kSide = 31;

}  // namespace

std::uint32_t EmptySphere::word() const {
  std::uint32_t bits = static_cast<std::uint32_t>(steps) << kFirstStep | (inside ? 1U : 0U) << kSide;
  for (int k = 0; k < 3; ++k) {
    constexpr std::uint32_t kMask = (1U << kOffsetBits) - 1;
    bits |= (static_cast<std::uint32_t>(offset[k]) & kMask) << (kFirstOffset + kOffsetBits * k);
  }
  return bits;
}

EmptySphere EmptySphere::of(std::uint32_t word) {
  EmptySphere ball;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t high = word << (32 - kOffsetBits - kFirstOffset - kOffsetBits * k);
    ball.offset[k] = static_cast<std::int32_t>(high) >> (32 - kOffsetBits);
  }
  ball.steps = static_cast<int>(word >> kFirstStep) & kMaxSteps;
  ball.inside = word >> kSide != 0;
  return ball;
}

}  // namespace sdf_ccd
