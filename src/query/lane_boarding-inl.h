// Included once for each kind of processor that vector code is compiled for.
#if defined(SDF_CCD_LANE_BOARDING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_CCD_LANE_BOARDING_INL_H_
#undef SDF_CCD_LANE_BOARDING_INL_H_
#else
#define SDF_CCD_LANE_BOARDING_INL_H_
#endif

#include <algorithm>

#include <hwy/highway.h>

#include "segment_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Segments on their way into a queue, clipped to the grid's box in double precision: a segment may start far outside.
struct Boarding {
  static constexpr int kGroup = 16;
  static constexpr double kSurelyWithinReach = 4e11;  ///< from the grid's origin, and along the segment [m]

  float o[3][kGroup], d[3][kGroup];
  float t0[kGroup], t1[kGroup];  ///< the part of each segment that lies in the box
  std::int32_t within[kGroup];   ///< 1, or 0 for those that do not meet the box
  bool doubtful = false;         ///< one may not be within reach

  Boarding(const LaneBox& g, const Segment* segments, int count) {
    // Number by number: gathers take longer.
    alignas(64) double at[3][kGroup], way[3][kGroup];
    for (int i = 0; i < kGroup; ++i) {
      const Segment& s = segments[std::min(i, count - 1)];
      for (int k = 0; k < 3; ++k) {
        at[k][i] = s.start[k];
        way[k][i] = s.end[k];
      }
    }
    for (int i = 0; i < kGroup; i += int(hn::Lanes(wide))) clip(g, at, way, i);
  }

 private:
  using Wide = hn::ScalableTag<double>;
  static constexpr Wide wide{};

  void clip(const LaneBox& g, const double (*starts)[kGroup], const double (*ends)[kGroup], int i) {
    const hn::Rebind<float, Wide> narrow;
    const hn::Rebind<std::int32_t, Wide> whole_narrow;
    using V = hn::Vec<Wide>;
    const V zero = hn::Zero(wide), one = hn::Set(wide, 1.0), units = hn::Set(wide, g.units_per_metre);
    V at[3], way[3];
    for (int k = 0; k < 3; ++k) {
      const V start = hn::LoadU(wide, starts[k] + i), end = hn::LoadU(wide, ends[k] + i);
      at[k] = hn::Mul(hn::Sub(start, hn::Set(wide, g.origin[k])), units);
      way[k] = hn::Mul(hn::Sub(end, start), units);
    }
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
    const auto store = [&](V v, float* column) { hn::StoreU(hn::DemoteTo(narrow, v), narrow, column + i); };
    const V length = hn::Sub(to, from);
    for (int k = 0; k < 3; ++k) {
      store(hn::MulAdd(from, way[k], at[k]), o[k]);
      store(hn::Mul(length, way[k]), d[k]);
    }
    store(from, t0);
    store(to, t1);
    const V meets = hn::IfThenElseZero(hn::Le(from, to), one);
    hn::StoreU(hn::DemoteTo(whole_narrow, meets), whole_narrow, within + i);
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
