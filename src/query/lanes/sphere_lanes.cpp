// Vector code that is compiled once for each kind of processor; see segment_lanes.cpp.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/lanes/sphere_lanes.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "lane_adaptive-inl.h"
#include "lane_uniform-inl.h"
#include "query/swept_side.h"
#include "sphere_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

/// Empty spheres [units].
struct EmptySpheres {
  HWY_INLINE EmptySpheres() {}  // as Blocks()

  VF center[3];
  VF radius;  ///< negative: none
  MI inside;

  /// Around points of known distance; the radius is reduced by the rounding of single precision, and by `less`.
  void setDistance(VF signed_distance, float less) {
    inside = asWhole(hn::Lt(signed_distance, real(0.0F)));
    setRadius(hn::Abs(signed_distance), less);
  }
  void setRadius(VF of, float less) { radius = hn::MulAdd(of, real(1.0F - 1e-5F), real(-0.01F - less)); }

  void replace(MI which, const EmptySpheres& by) {
    for (int k = 0; k < 3; ++k) center[k] = hn::IfThenElse(asReal(which), by.center[k], center[k]);
    radius = hn::IfThenElse(asReal(which), by.radius, radius);
    inside = hn::Or(hn::And(which, by.inside), hn::AndNot(which, inside));
  }
};

/// The empty spheres of far blocks.
HWY_INLINE EmptySpheres emptySpheres(const Blocks& at, const Lanes& lanes) {
  const VI mask = hn::Neg(hn::Shl(whole(1), at.log_side));
  EmptySpheres balls;
  for (int k = 0; k < 3; ++k) balls.center[k] = hn::Add(hn::ConvertTo(f, hn::And(lanes.cell[k], mask)), at.ball[k]);
  balls.setRadius(at.radius, 0.0F);
  balls.inside = at.inside;
  return balls;
}

/// Empty spheres about the lanes' positions, clamped to their leaves.
HWY_INLINE EmptySpheres leafBalls(const AdaptiveLanes& g, const Lanes& lanes, const Fetched& fetched) {
  const LeafCorners corners = leafCorners(g, lanes, fetched, 0);
  const VI side = hn::Shl(whole(1), lanes.log_side), mask = hn::Neg(side);
  const VF length = hn::ConvertTo(f, side), per_side = hn::Div(real(1.0F), length);
  EmptySpheres balls;
  VF u[3];
  for (int k = 0; k < 3; ++k) {
    const VF low = hn::ConvertTo(f, hn::And(lanes.cell[k], mask));
    const VF from_low = hn::Min(hn::Max(hn::Sub(lanes.at(k), low), real(0.0F)), length);
    u[k] = hn::Mul(from_low, per_side);
    balls.center[k] = hn::Add(from_low, low);
  }
  const auto between = [](VF a, VF b, VF at) { return hn::MulAdd(at, hn::Sub(b, a), a); };
  const VF* c = corners.corner;
  const VF y0 = between(between(c[0], c[1], u[0]), between(c[2], c[3], u[0]), u[1]);
  const VF y1 = between(between(c[4], c[5], u[0]), between(c[6], c[7], u[0]), u[1]);
  balls.setDistance(hn::Mul(hn::Sub(between(y0, y1, u[2]), corners.iso), corners.step), g.margin);
  return balls;
}

/// Empty spheres about the samples that are nearest to the lanes.
HWY_INLINE EmptySpheres sampleBalls(const UniformLanes& g, const Lanes& lanes, const Fetched& fetched) {
  const NearestSample nearest(lanes);
  const VI word = hn::LoadU(n, fetched.word.data());
  EmptySpheres balls;
  for (int k = 0; k < 3; ++k) balls.center[k] = nearest.center[k];
  balls.setDistance(hn::Mul(hn::ConvertTo(f, word), real(g.per_sample)), g.rounding);
  return balls;
}

/// Advances vectors of spheres from one empty sphere to the next until all lanes have a result; neighbours in a tree
/// usually need the same steps.
template <class Grid>
class Sweeper {
 public:
  Sweeper(const Grid& grid, const SphereSweep& sweep, SphereGroup& group, SphereWork& work)
      : g_(grid), sweep_(sweep), group_(group), work_(work), long_(sweep.isLong()) {}

  void run() {
    for (int i = 0; i < group_.size; i += static_cast<int>(hn::Lanes(f))) follow(i);
  }

 private:
  static constexpr int kMaxBalls = 32;
  static constexpr auto kOutside = static_cast<std::int32_t>(SweptSide::kOutside);
  static constexpr auto kInside = static_cast<std::int32_t>(SweptSide::kInside);
  static constexpr auto kUnknown = static_cast<std::int32_t>(SweptSide::kUnknown);

  /// The centres' paths are o + t d for t in [-1, 1]; Lanes::enter is the radius plus rounding.
  void follow(int first) {
    Lanes lanes(work_.waiting, 0, none());
    enqueue(lanes, first);
    const MI apart = long_ ? clip(lanes) : beyondBox(lanes);
    VI side = hn::IfThenElse(apart, whole(kOutside), whole(kUnknown));
    const MI active = hn::AndNot(apart, hn::FirstN(n, static_cast<std::size_t>(group_.size - first)));
    if (!hn::AllFalse(n, active)) {
      const EmptySpheres balls = ballsAt(lanes, active);
      const Passage middle = passageOf(balls, lanes);
      const MI all = hn::And(active, asWhole(middle.holdsAll()));
      side = hn::IfThenElse(all, hn::IfThenElse(balls.inside, whole(kInside), whole(kOutside)), side);
      if (long_) {
        const MI rest = hn::AndNot(all, hn::And(active, asWhole(middle.isWide())));
        if (!hn::AllFalse(n, rest)) side = followLong(lanes, balls.inside, middle, rest, side);
      }
    }
    hn::StoreU(side, n, group_.side.data() + first);
  }

  HWY_INLINE void enqueue(Lanes& lanes, int first) const {
    VF p[3];
    for (int k = 0; k < 3; ++k) p[k] = hn::LoadU(f, group_.center[k].data() + first);
    const auto placed = [&](const std::array<float, 4>& row) {
      const VF last = hn::MulAdd(real(row[2]), p[2], real(row[3]));
      return hn::MulAdd(real(row[0]), p[0], hn::MulAdd(real(row[1]), p[1], last));
    };
    for (int k = 0; k < 3; ++k) {
      lanes.o[k] = placed(sweep_.middle[k]);
      lanes.d[k] = placed(sweep_.displacement[k]);
    }
    const VF radius = hn::LoadU(f, group_.radius.data() + first);
    lanes.enter =
        hn::MulAdd(radius, real(static_cast<float>(g_.units_per_metre) * (1.0F + 1e-6F)), real(sweep_.rounding));
    lanes.t = real(0.0F);
  }

  /// For short paths: the lanes that are entirely farther from the surface's box than their margin.
  MI beyondBox(const Lanes& lanes) const {
    VF distance2 = real(0.0F);
    for (int k = 0; k < 3; ++k) {
      const VF below = hn::Sub(real(sweep_.surface_low[k]), lanes.o[k]);
      const VF above = hn::Sub(lanes.o[k], real(sweep_.surface_high[k]));
      const VF beyond = hn::Max(hn::Max(below, above), real(0.0F));
      distance2 = hn::MulAdd(beyond, beyond, distance2);
    }
    const VF margin = hn::Add(lanes.enter, real(sweep_.margin + sweep_.max_displacement));
    return asWhole(hn::And(hn::Gt(margin, real(0.0F)), hn::Gt(distance2, hn::Mul(margin, margin))));
  }

  /// Clips paths to the neighbourhood of the surface's box. @return lanes that are entirely outside of it.
  MI clip(Lanes& lanes) const {
    const VF one = real(1.0F), minus_one = real(-1.0F), zero = real(0.0F);
    const VF reach = hn::Add(lanes.enter, real(sweep_.margin));
    VF from = minus_one, to = one;
    for (int k = 0; k < 3; ++k) {
      const VF low = hn::Sub(hn::Sub(real(sweep_.surface_low[k]), reach), lanes.o[k]);
      const VF high = hn::Sub(hn::Add(real(sweep_.surface_high[k]), reach), lanes.o[k]);
      const MF still = hn::Lt(hn::Abs(lanes.d[k]), real(1e-20F));
      const VF inverse = hn::Div(one, hn::IfThenElse(still, one, lanes.d[k]));
      const VF a = hn::Mul(low, inverse), b = hn::Mul(high, inverse);
      const MF beside = hn::And(still, hn::Or(hn::Gt(low, zero), hn::Lt(high, zero)));
      from = hn::Max(from, hn::IfThenElse(still, minus_one, hn::Min(a, b)));
      to = hn::Min(to, hn::IfThenElse(still, one, hn::Max(a, b)));
      to = hn::IfThenElse(beside, real(-2.0F), to);
    }
    const VF middle = hn::Mul(hn::Add(from, to), real(0.5F)), half = hn::Mul(hn::Sub(to, from), real(0.5F));
    for (int k = 0; k < 3; ++k) {
      lanes.o[k] = hn::MulAdd(middle, lanes.d[k], lanes.o[k]);
      lanes.d[k] = hn::Mul(half, lanes.d[k]);
    }
    return asWhole(hn::Gt(from, to));
  }

  /// The paths of lanes relative to empty spheres whose radii are reduced by the lanes' radii and margins.
  struct Passage {
    VF along;    ///< dot product of d and the vector from the empty sphere's centre
    VF from2;    ///< distance from the empty sphere's centre, squared
    VF length2;  ///< of d
    VF radius, margin;

    MF holdsAll() const {
      const VF farthest2 = hn::Add(hn::Add(from2, length2), hn::Mul(hn::Abs(along), real(2.0F)));
      return hn::And(hn::Gt(radius, real(0.0F)), hn::Lt(farthest2, hn::Mul(radius, radius)));
    }

    /// Whether the empty sphere contains the lane, and is large enough to be faster than the exact test.
    MF isWide() const {
      return hn::And(hn::Gt(radius, margin),
                     hn::And(hn::Gt(radius, real(0.0F)), hn::Lt(from2, hn::Mul(radius, radius))));
    }

    VF exit(VF sign) const {
      const VF excess = hn::NegMulAdd(radius, radius, from2);
      const VF root = hn::Sqrt(hn::Max(hn::NegMulAdd(length2, excess, hn::Mul(along, along)), real(0.0F)));
      return hn::Div(hn::Sub(hn::Mul(sign, root), along), length2);
    }
  };

  HWY_INLINE Passage passageOf(const EmptySpheres& balls, const Lanes& lanes) const {
    Passage passage{real(0.0F), real(0.0F), real(1e-20F), {}, {}};
    for (int k = 0; k < 3; ++k) {
      const VF from = hn::Sub(lanes.at(k), balls.center[k]);
      passage.along = hn::MulAdd(from, lanes.d[k], passage.along);
      passage.from2 = hn::MulAdd(from, from, passage.from2);
      passage.length2 = hn::MulAdd(lanes.d[k], lanes.d[k], passage.length2);
    }
    passage.margin = hn::Add(lanes.enter, real(sweep_.margin));
    passage.radius = hn::Sub(balls.radius, passage.margin);
    return passage;
  }

  /// Follows paths from the empty sphere about the middle to the end, then to the start. @return the sides.
  HWY_NOINLINE VI followLong(Lanes& lanes, MI inside, const Passage& middle, MI active, VI side) {
    const VF one = real(1.0F), minus_one = real(-1.0F);
    VF high = middle.exit(one), low = middle.exit(minus_one);  // between them all points are on one side
    for (int i = 1; i < kMaxBalls; ++i) {
      const MF forward = hn::Lt(high, one);
      lanes.t = hn::IfThenElse(forward, high, low);
      const EmptySpheres balls = ballsAt(lanes, active);
      const Passage passage = passageOf(balls, lanes);
      active = hn::And(active, hn::AndNot(hn::Xor(inside, balls.inside), asWhole(passage.isWide())));
      const VF next = hn::Add(lanes.t, passage.exit(hn::IfThenElse(forward, one, minus_one)));
      high = hn::IfThenElse(forward, next, high);
      low = hn::IfThenElse(forward, low, next);
      const MI all = hn::And(active, asWhole(hn::And(hn::Ge(high, one), hn::Le(low, minus_one))));
      side = hn::IfThenElse(all, hn::IfThenElse(inside, whole(kInside), whole(kOutside)), side);
      active = hn::AndNot(all, active);
      if (hn::AllFalse(n, active)) break;
    }
    return side;
  }

  /// Empty spheres that may contain the lanes, from the grid's data at their positions.
  HWY_INLINE EmptySpheres ballsAt(Lanes& lanes, MI active) {
    findCells(g_, lanes);
    hn::StoreU(topIndex(g_, lanes.cell), n, work_.waiting.index.data());
    std::int32_t* word = work_.fetched.word.data();
    fetchTop(g_, work_.waiting.index.data(), static_cast<int>(hn::Lanes(n)), word);
    const Blocks at = locateTop(g_, hn::LoadU(n, word), lanes.cell);
    EmptySpheres balls = emptySpheres(at, lanes);
    descend(g_, at, active, lanes, balls);
    return balls;
  }

  HWY_INLINE void descend(const AdaptiveLanes& grid, Blocks at, MI active, Lanes& lanes, EmptySpheres& balls) {
    MI node = hn::And(active, at.node), leaf = hn::AndNot(hn::Or(at.far, at.node), active);
    VI index = at.index;
    lanes.log_side = at.log_side;
    while (!hn::AllFalse(n, node)) {
      await(node, index, lanes);
      fetchBelow(grid, work_.waiting, work_.fetched);
      at = locateBelow(grid, lanes, work_.fetched, 0);
      balls.replace(hn::And(node, at.far), emptySpheres(at, lanes));
      index = hn::IfThenElse(node, at.index, index);
      lanes.log_side = hn::IfThenElse(node, at.log_side, lanes.log_side);
      leaf = hn::Or(leaf, hn::AndNot(hn::Or(at.far, at.node), node));
      node = hn::And(node, at.node);
    }
    if (hn::AllFalse(n, leaf)) return;
    await(leaf, index, lanes);
    fetchLeaves(grid, work_.waiting, work_.fetched);
    balls.replace(leaf, leafBalls(grid, lanes, work_.fetched));
  }

  HWY_INLINE void descend(const UniformLanes& grid, const Blocks& at, MI active, Lanes& lanes, EmptySpheres& balls) {
    const MI brick = hn::And(active, at.node);
    if (hn::AllFalse(n, brick)) return;
    RayQueue& queue = work_.waiting;
    for (int k = 0; k < 3; ++k) {
      hn::StoreU(lanes.o[k], f, queue.o[k].data());
      hn::StoreU(lanes.d[k], f, queue.d[k].data());
    }
    hn::StoreU(lanes.t, f, queue.t.data());
    await(brick, at.index, lanes);
    fetchBelow(grid, queue, work_.fetched);
    balls.replace(brick, sampleBalls(grid, lanes, work_.fetched));
  }

  /// Enqueues the lanes of a mask for their blocks' memory; the other lanes get the block of one of these.
  HWY_INLINE void await(MI which, VI index, const Lanes& lanes) {
    RayQueue& queue = work_.waiting;
    hn::StoreU(index, n, queue.index.data());
    const std::int32_t known = queue.index[hn::FindKnownFirstTrue(n, which)];
    hn::StoreU(hn::IfThenElse(which, index, whole(known)), n, queue.index.data());
    hn::StoreU(lanes.log_side, n, queue.log_side.data());
    for (int k = 0; k < 3; ++k) hn::StoreU(lanes.cell[k], n, queue.cell[k].data());
    queue.size = static_cast<int>(hn::Lanes(n));
  }

  const Grid& g_;
  const SphereSweep& sweep_;
  SphereGroup& group_;
  SphereWork& work_;
  const bool long_;
};

}  // namespace

void sweepAdaptive(const AdaptiveLanes& grid, const SphereSweep& sweep, SphereGroup& group, SphereWork& work) {
  Sweeper(grid, sweep, group, work).run();
}

void sweepUniform(const UniformLanes& grid, const SphereSweep& sweep, SphereGroup& group, SphereWork& work) {
  Sweeper(grid, sweep, group, work).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sdf_ccd {

HWY_EXPORT(sweepAdaptive);
HWY_EXPORT(sweepUniform);

void sweepSpheres(const AdaptiveLanes& grid, const SphereSweep& sweep, SphereGroup& group, SphereWork& work) {
  HWY_DYNAMIC_DISPATCH(sweepAdaptive)(grid, sweep, group, work);
}

void sweepSpheres(const UniformLanes& grid, const SphereSweep& sweep, SphereGroup& group, SphereWork& work) {
  HWY_DYNAMIC_DISPATCH(sweepUniform)(grid, sweep, group, work);
}

SphereSweep::SphereSweep(const DistanceField& field, const LaneBox& box, const Chord& chord, double margin_m,
                         const BoundingBall& shell) {
  const auto start = chord.X_FP_start.matrix(), end = chord.X_FP_end.matrix();
  const double units = box.units_per_metre, reach = shell.center.norm() + shell.radius;
  double farthest = 0.0;  // upper bound of the sum of the terms of a coordinate
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 4; ++i) {
      const double at = units * (0.5 * (start(k, i) + end(k, i)) - (i == 3 ? box.origin[k] : 0.0));
      const double step = units * 0.5 * (end(k, i) - start(k, i));
      middle[k][i] = static_cast<float>(at);
      displacement[k][i] = static_cast<float>(step);
      farthest += (i == 3 ? 1.0 : reach) * (std::abs(at) + std::abs(step));
    }
    surface_low[k] = static_cast<float>(units * (field.surfaceBox().min()[k] - box.origin[k]));
    surface_high[k] = static_cast<float>(units * (field.surfaceBox().max()[k] - box.origin[k]));
  }
  rounding = static_cast<float>(1e-6 * farthest) + 0.01F;
  const Matrix3d difference = 0.5 * (chord.X_FP_end.linear() - chord.X_FP_start.linear());
  const Vector3d travel = 0.5 * (chord.X_FP_end * shell.center - chord.X_FP_start * shell.center);
  max_displacement = static_cast<float>(units * (travel.norm() + difference.norm() * shell.radius));
  margin = static_cast<float>(margin_m * units);
}

}  // namespace sdf_ccd
#endif
