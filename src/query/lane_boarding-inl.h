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

/// Segments on their way into a queue, clipped to the grid's box in double precision: a segment may start far outside.
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
  using Wide = hn::ScalableTag<double>;
  using V = hn::Vec<Wide>;
  static constexpr Wide wide{};

  void clipAll(const LaneBox& g, const Segment* segments) {
    for (int i = 0; i < kGroup; i += int(hn::Lanes(wide))) clip(g, segments + i, i);
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

  void clip(const LaneBox& g, const Segment* segments, int i) {
    const V zero = hn::Zero(wide), one = hn::Set(wide, 1.0), units = hn::Set(wide, g.units_per_metre);
    V at[3], way[3];
    load(segments, at, way);
    auto inside = hn::Eq(zero, zero);
    for (int k = 0; k < 3; ++k) {
      const V origin = hn::Set(wide, g.origin[k]), size = hn::Set(wide, double(g.top_size[k]) * LaneBox::kUnits);
      const V start = hn::Mul(hn::Sub(at[k], origin), units), end = hn::Mul(hn::Sub(way[k], origin), units);
      inside = hn::And(inside, hn::And(hn::Ge(hn::Min(start, end), zero), hn::Le(hn::Max(start, end), size)));
      way[k] = hn::Mul(hn::Sub(way[k], at[k]), units);
      at[k] = start;
    }
    if (hn::AllTrue(wide, inside)) return store(at, way, zero, one, one, i);

    const V reach = hn::Set(wide, kSurelyWithinReach * g.units_per_metre);
    V from = zero, to = one;
    for (int k = 0; k < 3; ++k) {
      const V size = hn::Set(wide, double(g.top_size[k]) * LaneBox::kUnits);
      const auto near = hn::And(hn::Le(hn::Abs(at[k]), reach), hn::Le(hn::Abs(way[k]), reach));
      doubtful = doubtful || !hn::AllTrue(wide, near);
      const auto still = hn::Eq(way[k], zero);
      const V per_way = hn::Div(one, hn::IfThenElse(still, one, way[k]));
      const V a = hn::Mul(hn::Neg(at[k]), per_way), b = hn::Mul(hn::Sub(size, at[k]), per_way);
      const auto beside = hn::And(still, hn::Or(hn::Lt(at[k], zero), hn::Gt(at[k], size)));
      from = hn::Max(from, hn::IfThenElse(still, zero, hn::Min(a, b)));
      to = hn::Min(to, hn::IfThenElse(still, one, hn::Max(a, b)));
      to = hn::IfThenElse(beside, hn::Set(wide, -1.0), to);
    }
    const V length = hn::Sub(to, from);
    for (int k = 0; k < 3; ++k) {
      at[k] = hn::MulAdd(from, way[k], at[k]);
      way[k] = hn::Mul(length, way[k]);
    }
    store(at, way, from, to, hn::IfThenElseZero(hn::Le(from, to), one), i);
  }

  void store(const V* at, const V* way, V from, V to, V meets, int i) {
    const hn::Rebind<float, Wide> narrow;
    const hn::Rebind<std::int32_t, Wide> whole_narrow;
    for (int k = 0; k < 3; ++k) {
      hn::StoreU(hn::DemoteTo(narrow, at[k]), narrow, o[k] + i);
      hn::StoreU(hn::DemoteTo(narrow, way[k]), narrow, d[k] + i);
    }
    hn::StoreU(hn::DemoteTo(narrow, from), narrow, t0 + i);
    hn::StoreU(hn::DemoteTo(narrow, to), narrow, t1 + i);
    hn::StoreU(hn::DemoteTo(whole_narrow, meets), whole_narrow, within + i);
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
