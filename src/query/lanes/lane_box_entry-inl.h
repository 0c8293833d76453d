// Included once for each kind of processor that vector code is compiled for.
#if defined(SDF_CCD_LANE_BOX_ENTRY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_CCD_LANE_BOX_ENTRY_INL_H_
#undef SDF_CCD_LANE_BOX_ENTRY_INL_H_
#else
#define SDF_CCD_LANE_BOX_ENTRY_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <hwy/highway.h>

#include "segment_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Segments clipped to the grid's box, in double precision if they extend far outside it. Each step is done for all of
/// them before the next, as reading a vector just after writing parts of it stalls. No vector straddles cache lines.
struct HWY_ALIGN_MAX BoxEntry {
  static constexpr int kMaxSegments = 128;

  float o[3][kMaxSegments], d[3][kMaxSegments];
  float *t0, *t1;         ///< the part of each segment within the box; t0 > t1 if there is none
  bool doubtful = false;  ///< whether one of the segments may not be within reach

  /// Takes 1 to kMaxSegments segments; copies of the last one fill up its vector.
  /// @param begins, ends  where t0 and t1 are written
  BoxEntry(const LaneBox& g, const Segment* segments, int count, float* begins, float* ends) : t0(begins), t1(ends) {
    HWY_ALIGN float numbers[kNumbers * kMaxSegments];
    convert(g, segments, count, numbers);
    deinterleave(numbers, count);
    clipAll(g, segments, count);
  }

 private:
  using Single = hn::ScalableTag<float>;
  using Wide = hn::ScalableTag<double>;
  using OneWide = hn::CappedTag<double, 1>;
  static constexpr Single single{};
  static constexpr int kNumbers = 6;
  static_assert(sizeof(Segment) == kNumbers * sizeof(double), "numbers without gaps");
  static_assert(kMaxSegments % hn::MaxLanes(single) == 0, "whole vectors");

  /// Starts, and displacements from there, relative to the grid's origin [units].
  template <class Tag>
  struct Rays {
    HWY_INLINE Rays() {}  // as Blocks()
    hn::Vec<Tag> at[3], displacement[3];
  };

  template <class Tag>
  struct Part {
    hn::Vec<Tag> from, to;
  };

  static int lanes() { return static_cast<int>(hn::Lanes(single)); }

  /// Converts starts and ends to single precision, after subtracting the grid's origin [units]; in the same order.
  static void convert(const LaneBox& g, const Segment* segments, int count, float* relative) {
    constexpr Wide wide;
    constexpr hn::Rebind<float, Wide> narrow;
    const int step = static_cast<int>(hn::Lanes(wide)), all = kNumbers * count;
    double origins[3 * hn::MaxLanes(wide)];
    for (std::size_t i = 0; i < std::size(origins); ++i) origins[i] = g.origin[i % 3];
    const auto units = hn::Set(wide, g.units_per_metre);
    const double* numbers = segments->start.data();
    int j = 0;
    for (; j + 3 * step <= all; j += 3 * step) {
      for (int k = 0; k < 3 * step; k += step) {
        const auto number = hn::Sub(hn::LoadU(wide, numbers + j + k), hn::LoadU(wide, origins + k));
        hn::StoreU(hn::DemoteTo(narrow, hn::Mul(number, units)), narrow, relative + j + k);
      }
    }
    for (; j < all; ++j) relative[j] = static_cast<float>((numbers[j] - g.origin[j % 3]) * g.units_per_metre);
    const int whole_vectors = (count + lanes() - 1) / lanes() * lanes();
    for (; j < kNumbers * whole_vectors; ++j) relative[j] = relative[j - kNumbers];
  }

  void deinterleave(const float* relative, int count) {
    for (int i = 0; i < count; i += lanes()) {
#if HWY_TARGET == HWY_SCALAR
      for (int k = 0; k < 3; ++k) {
        o[k][i] = relative[kNumbers * i + k];
        d[k][i] = relative[kNumbers * i + 3 + k] - o[k][i];
      }
#else
      hn::Vec<Single> low[3], high[3];  // a start, an end, a start, ...
      const float* numbers = relative + kNumbers * i;
      hn::LoadInterleaved3(single, numbers, low[0], low[1], low[2]);
      hn::LoadInterleaved3(single, numbers + 3 * lanes(), high[0], high[1], high[2]);
      for (int k = 0; k < 3; ++k) {
        const auto start = hn::ConcatEven(single, high[k], low[k]), end = hn::ConcatOdd(single, high[k], low[k]);
        put(start, o[k] + i);
        put(hn::Sub(end, start), d[k] + i);
      }
#endif
    }
  }

  /// Segments that stay within this distance of the grid's origin are clipped in single precision [units].
  static double nearReach(const LaneBox& g) {
    return 2.0 * std::max({g.top_size[0], g.top_size[1], g.top_size[2]}) * LaneBox::kUnits;
  }

  void clipAll(const LaneBox& g, const Segment* segments, int count) {
    const auto reach = hn::Set(single, static_cast<float>(0.9 * nearReach(g)));
    const auto zero = hn::Zero(single), one = hn::Set(single, 1.0F);
    for (int i = 0; i < count; i += lanes()) {
      Rays<Single> rays;
      auto inside = hn::Eq(one, one), surely_near = inside;  // false for NaN, which fails every comparison
      for (int k = 0; k < 3; ++k) {
        rays.at[k] = hn::LoadU(single, o[k] + i);
        rays.displacement[k] = hn::LoadU(single, d[k] + i);
        const auto size = hn::Set(single, static_cast<float>(g.top_size[k] * LaneBox::kUnits));
        const hn::Vec<Single> ends[] = {rays.at[k], hn::Add(rays.at[k], rays.displacement[k])};
        for (const auto& end : ends) {
          inside = hn::And(inside, hn::And(hn::Ge(end, zero), hn::Le(end, size)));
          surely_near = hn::And(surely_near, hn::Le(hn::Abs(end), reach));
        }
      }
      if (hn::AllTrue(single, inside)) {
        put(zero, t0 + i);
        put(one, t1 + i);
        continue;
      }
      store<Single>(clip(single, g, inside, rays), rays, i);
      if (hn::AllTrue(single, surely_near)) continue;
      for (int j = i; j < std::min(i + lanes(), count); ++j) clipFar(g, segments[j], j);
    }
  }

  /// Clips a segment again, in double precision, if it extends farther than nearReach().
  void clipFar(const LaneBox& g, const Segment& segment, int i) {
    constexpr OneWide wide;
    const double reach = kSurelyWithinReach * g.units_per_metre;
    Rays<OneWide> rays;
    bool near = true;
    for (int k = 0; k < 3; ++k) {
      const double at = (segment.start[k] - g.origin[k]) * g.units_per_metre;
      const double displacement = (segment.end[k] - segment.start[k]) * g.units_per_metre;
      near = near && std::max(std::abs(at), std::abs(at + displacement)) <= nearReach(g);
      doubtful = doubtful || !(std::abs(at) <= reach && std::abs(displacement) <= reach);
      rays.at[k] = hn::Set(wide, at);
      rays.displacement[k] = hn::Set(wide, displacement);
    }
    if (!near) store<OneWide>(clip(wide, g, hn::MaskFromVec(hn::Zero(wide)), rays), rays, i);
  }

  static constexpr double kSurelyWithinReach = 4e11;  ///< from the grid's origin, and along the segment [m]

  /// Clips segments to the box. @param inside  lanes whose segment lies entirely inside the box.
  template <class Tag>
  static Part<Tag> clip(Tag tag, const LaneBox& g, hn::Mask<Tag> inside, Rays<Tag>& rays) {
    using T = hn::TFromD<Tag>;
    const auto zero = hn::Zero(tag), one = hn::Set(tag, T(1));
    auto from = zero, to = one;
    for (int k = 0; k < 3; ++k) {
      const auto at = rays.at[k], displacement = rays.displacement[k];
      const auto size = hn::Set(tag, T(g.top_size[k] * LaneBox::kUnits));
      const auto still = hn::Lt(hn::Abs(displacement), hn::Set(tag, T(1e-30)));
      const auto inverse = hn::Div(one, hn::IfThenElse(still, one, displacement));
      const auto a = hn::Mul(hn::Neg(at), inverse), b = hn::Mul(hn::Sub(size, at), inverse);
      const auto beside = hn::And(still, hn::Or(hn::Lt(at, zero), hn::Gt(at, size)));
      from = hn::Max(from, hn::IfThenElse(still, zero, hn::Min(a, b)));
      to = hn::Min(to, hn::IfThenElse(still, one, hn::Max(a, b)));
      to = hn::IfThenElse(beside, hn::Set(tag, T(-1)), to);
    }
    to = hn::IfThenElse(inside, one, to);  // despite rounding
    const auto length = hn::Sub(to, from);
    for (int k = 0; k < 3; ++k) {
      rays.at[k] = hn::MulAdd(from, rays.displacement[k], rays.at[k]);
      rays.displacement[k] = hn::Mul(length, rays.displacement[k]);
    }
    return {from, to};
  }

  template <class Tag>
  void store(const Part<Tag>& part, const Rays<Tag>& rays, int i) {
    for (int k = 0; k < 3; ++k) {
      put(rays.at[k], o[k] + i);
      put(rays.displacement[k], d[k] + i);
    }
    put(part.from, t0 + i);
    put(part.to, t1 + i);
  }

  static void put(hn::Vec<Single> v, float* to) {
    hn::StoreU(v, single, to);
  }
  static void put(hn::Vec<OneWide> v, float* to) {
    *to = static_cast<float>(hn::GetLane(v));
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
