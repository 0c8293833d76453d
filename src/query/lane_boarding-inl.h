// Included once for each kind of processor that vector code is compiled for.
#if defined(SDF_CCD_LANE_BOARDING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_CCD_LANE_BOARDING_INL_H_
#undef SDF_CCD_LANE_BOARDING_INL_H_
#else
#define SDF_CCD_LANE_BOARDING_INL_H_
#endif

#include <algorithm>
#include <array>

#include <hwy/highway.h>

#include "segment_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Segments on their way into a queue, clipped to the grid's box: in double precision where one starts far outside.
struct Boarding {
  static constexpr int kGroup = 32;
  static constexpr double kSurelyWithinReach = 4e11;  ///< from the grid's origin, and along the segment [m]

  float o[3][kGroup], d[3][kGroup];
  float t0[kGroup], t1[kGroup];  ///< the part of each segment that lies in the box
  std::int32_t within[kGroup];   ///< 1, or 0 for those that do not meet the box
  bool doubtful = false;         ///< one may not be within reach

  /// Of a group; of less, the last one stands in for the others.
  Boarding(const LaneBox& g, const Segment* segments, int count) {
    if (count < kGroup) {
      std::array<Segment, kGroup> filled;
      for (int i = 0; i < kGroup; ++i) filled[i] = segments[std::min(i, count - 1)];
      clipAll(g, filled.data());
    } else {
      clipAll(g, segments);
    }
  }

 private:
  using Single = hn::ScalableTag<float>;
  using Wide = hn::ScalableTag<double>;
  using V = hn::Vec<Wide>;
  static constexpr Single single{};
  static constexpr Wide wide{};
  static constexpr hn::Rebind<float, Wide> narrow{};

  void clipAll(const LaneBox& g, const Segment* segments) {
    bool near = true;
    for (int i = 0; i < kGroup; i += int(hn::Lanes(wide))) near = convert(g, segments + i, i) && near;
    if (near) {
      for (int i = 0; i < kGroup; i += int(hn::Lanes(single))) clipConverted(g, i);
    } else {
      for (int i = 0; i < kGroup; i += int(hn::Lanes(wide))) clipFar(g, segments + i, i);
    }
  }

  /// Starts and ends of as many segments as there are lanes.
  static void load(const Segment* segments, V* starts, V* ends) {
#if HWY_TARGET == HWY_SCALAR
    for (int k = 0; k < 3; ++k) {
      starts[k] = hn::Set(wide, segments->start[k]);
      ends[k] = hn::Set(wide, segments->end[k]);
    }
#else
    static_assert(sizeof(Segment) == 6 * sizeof(double), "numbers without gaps");
    const double* numbers = segments->start.data();
    V low[3], high[3];  // a start, an end, a start, ...
    hn::LoadInterleaved3(wide, numbers, low[0], low[1], low[2]);
    hn::LoadInterleaved3(wide, numbers + 3 * hn::Lanes(wide), high[0], high[1], high[2]);
    for (int k = 0; k < 3; ++k) {
      starts[k] = hn::ConcatEven(wide, high[k], low[k]);
      ends[k] = hn::ConcatOdd(wide, high[k], low[k]);
    }
#endif
  }

  /// Starts, and ways from there, relative to the grid's origin [units].
  static void locate(const LaneBox& g, const Segment* segments, V* at, V* way) {
    const V units = hn::Set(wide, g.units_per_metre);
    load(segments, at, way);
    for (int k = 0; k < 3; ++k) {
      way[k] = hn::Mul(hn::Sub(way[k], at[k]), units);
      at[k] = hn::Mul(hn::Sub(at[k], hn::Set(wide, g.origin[k])), units);
    }
  }

  static double longest(const LaneBox& g) {
    return double(std::max({g.top_size[0], g.top_size[1], g.top_size[2]})) * LaneBox::kUnits;
  }

  /// As they come. @return whether all are so near the box that single precision will do for the rest.
  bool convert(const LaneBox& g, const Segment* segments, int i) {
    const V near = hn::Set(wide, 2.0 * longest(g));
    V at[3], way[3], farthest = hn::Zero(wide);
    locate(g, segments, at, way);
    for (int k = 0; k < 3; ++k) farthest = hn::Max(farthest, hn::Max(hn::Abs(at[k]), hn::Abs(way[k])));
    store(at, way, i);
    return hn::AllTrue(wide, hn::Le(farthest, near));
  }

  void clipConverted(const LaneBox& g, int i) {
    hn::Vec<Single> at[3], way[3];
    for (int k = 0; k < 3; ++k) {
      at[k] = hn::LoadU(single, o[k] + i);
      way[k] = hn::LoadU(single, d[k] + i);
    }
    const auto part = clip(single, g, at, way);
    for (int k = 0; k < 3; ++k) {
      hn::StoreU(at[k], single, o[k] + i);
      hn::StoreU(way[k], single, d[k] + i);
    }
    hn::StoreU(part.from, single, t0 + i);
    hn::StoreU(part.to, single, t1 + i);
    const hn::RebindToSigned<Single> whole;
    hn::StoreU(hn::ConvertTo(whole, part.meets), whole, within + i);
  }

  void clipFar(const LaneBox& g, const Segment* segments, int i) {
    V at[3], way[3];
    locate(g, segments, at, way);
    const V reach = hn::Set(wide, kSurelyWithinReach * g.units_per_metre);
    for (int k = 0; k < 3; ++k) {
      const auto near = hn::And(hn::Le(hn::Abs(at[k]), reach), hn::Le(hn::Abs(way[k]), reach));
      doubtful = doubtful || !hn::AllTrue(wide, near);
    }
    const auto part = clip(wide, g, at, way);
    store(at, way, i);
    hn::StoreU(hn::DemoteTo(narrow, part.from), narrow, t0 + i);
    hn::StoreU(hn::DemoteTo(narrow, part.to), narrow, t1 + i);
    const hn::Rebind<std::int32_t, Wide> whole;
    hn::StoreU(hn::DemoteTo(whole, part.meets), whole, within + i);
  }

  template <class Lane>
  struct Part {
    Lane from, to;
    Lane meets;  ///< 1, or 0 for segments that do not meet the box
  };

  /// Leaves of segments what lies in the box.
  template <class Tag, class Lane = hn::Vec<Tag>>
  static Part<Lane> clip(Tag tag, const LaneBox& g, Lane* at, Lane* way) {
    using T = hn::TFromD<Tag>;
    const Lane zero = hn::Zero(tag), one = hn::Set(tag, T(1));
    Lane from = zero, to = one;
    for (int k = 0; k < 3; ++k) {
      const Lane size = hn::Set(tag, T(g.top_size[k] * LaneBox::kUnits));
      const auto still = hn::Lt(hn::Abs(way[k]), hn::Set(tag, T(1e-30)));
      const Lane per_way = hn::Div(one, hn::IfThenElse(still, one, way[k]));
      const Lane a = hn::Mul(hn::Neg(at[k]), per_way), b = hn::Mul(hn::Sub(size, at[k]), per_way);
      const auto beside = hn::And(still, hn::Or(hn::Lt(at[k], zero), hn::Gt(at[k], size)));
      from = hn::Max(from, hn::IfThenElse(still, zero, hn::Min(a, b)));
      to = hn::Min(to, hn::IfThenElse(still, one, hn::Max(a, b)));
      to = hn::IfThenElse(beside, hn::Set(tag, T(-1)), to);
    }
    const Lane length = hn::Sub(to, from);
    for (int k = 0; k < 3; ++k) {
      at[k] = hn::MulAdd(from, way[k], at[k]);
      way[k] = hn::Mul(length, way[k]);
    }
    return {from, to, hn::IfThenElseZero(hn::Le(from, to), one)};
  }

  void store(const V* at, const V* way, int i) {
    for (int k = 0; k < 3; ++k) {
      hn::StoreU(hn::DemoteTo(narrow, at[k]), narrow, o[k] + i);
      hn::StoreU(hn::DemoteTo(narrow, way[k]), narrow, d[k] + i);
    }
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
