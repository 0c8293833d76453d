// Included once for each kind of processor that vector code is compiled for.
#if defined(SDF_CCD_LANE_CROSSING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_CCD_LANE_CROSSING_INL_H_
#undef SDF_CCD_LANE_CROSSING_INL_H_
#else
#define SDF_CCD_LANE_CROSSING_INL_H_
#endif

#include <hwy/highway.h>

#include "lane_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

/// Each lane's leaf: its eight corner values and the isovalue, in multiples of `step`.
struct LeafCorners {
  HWY_INLINE LeafCorners() {}  // as Blocks()

  VF corner[8];
  VF iso;
  VF step;  ///< [units]
};

/// The field in a leaf along each lane: a cubic of u in [0, 1] from the lane's position to its exit.
struct Crossing {
  VF c[4];
  VF at_end;  ///< its value at the lane's exit
  MF in_start, in_end;
  MF hard;    ///< several roots, or one that is not found in a few steps
  VF t_root;  ///< if the signs at both ends differ and the lane is not hard
};

inline Crossing crossingOf(const LeafCorners& leaf, const Lanes& lanes, const Exits& exits, VF t_exit) {
  // The cubic (see cellCubic()) of u in [0, 1] from the lane's position to its exit.
  const VF per_side = hn::Div(real(1.0F), hn::ConvertTo(f, exits.side));
  VF from[3], displacement[3];
  for (int k = 0; k < 3; ++k) {
    const VF base = hn::Sub(lanes.o[k], hn::ConvertTo(f, exits.low[k]));
    const auto clamped = [&](VF t) {
      const VF u = hn::Mul(hn::MulAdd(lanes.d[k], t, base), per_side);
      return hn::Min(hn::Max(u, real(0.0F)), real(1.0F));
    };
    from[k] = clamped(lanes.t);
    displacement[k] = hn::Sub(clamped(t_exit), from[k]);
  }
  const VF* q = leaf.corner;
  const VF xy0 = hn::Mul(from[0], from[1]), xy2 = hn::Mul(displacement[0], displacement[1]);
  const VF xy1 = hn::MulAdd(from[0], displacement[1], hn::Mul(from[1], displacement[0]));
  struct Quadratic {
    VF c0, c1, c2;
  };
  const auto plane = [&](VF k0, VF kx, VF ky, VF kxy) {
    return Quadratic{hn::MulAdd(kx, from[0], hn::MulAdd(ky, from[1], hn::MulAdd(kxy, xy0, k0))),
                     hn::MulAdd(kx, displacement[0], hn::MulAdd(ky, displacement[1], hn::Mul(kxy, xy1))),
                     hn::Mul(kxy, xy2)};
  };
  const VF ax = hn::Sub(q[1], q[0]), ay = hn::Sub(q[2], q[0]), axy = hn::Sub(hn::Sub(q[3], q[2]), ax);
  const Quadratic a = plane(hn::Sub(q[0], leaf.iso), ax, ay, axy);
  const VF bz = hn::Sub(q[4], q[0]), bx = hn::Sub(hn::Sub(q[5], q[4]), ax);
  const VF by = hn::Sub(hn::Sub(q[6], q[4]), ay);
  const VF bxy = hn::Sub(hn::Sub(hn::Sub(q[7], q[6]), hn::Sub(q[5], q[4])), axy);
  const Quadratic b = plane(bz, bx, by, bxy);
  const VF c0 = hn::MulAdd(from[2], b.c0, a.c0);
  const VF c1 = hn::MulAdd(from[2], b.c1, hn::MulAdd(displacement[2], b.c0, a.c1));
  const VF c2 = hn::MulAdd(from[2], b.c2, hn::MulAdd(displacement[2], b.c1, a.c2));
  const VF c3 = hn::Mul(displacement[2], b.c2);
  const auto value = [&](VF u) { return hn::MulAdd(u, hn::MulAdd(u, hn::MulAdd(u, c3, c2), c1), c0); };

  const VF zero = real(0.0F), one = real(1.0F);
  const VF at_end = value(one);
  const MF in_start = hn::Le(c0, zero), in_end = hn::Le(at_end, zero);
  const MF crossing = hn::Xor(in_start, in_end);
  const VF c33 = hn::Mul(c3, real(3.0F));
  // The Bézier coefficients of the cubic change sign at least as often as it does.
  const VF third = real(1.0F / 3.0F);
  const VF b1 = hn::MulAdd(c1, third, c0);
  const VF b2 = hn::MulAdd(hn::Add(c1, c2), third, b1);
  const MF in_1 = hn::Le(b1, zero), in_2 = hn::Le(b2, zero);
  const MF change_1 = hn::Xor(in_start, in_1), change_2 = hn::Xor(in_1, in_2), change_3 = hn::Xor(in_2, in_end);
  const MF may_turn = hn::Or(hn::And(change_1, hn::Or(change_2, change_3)), hn::And(change_2, change_3));
  MF several = asReal(none());
  if (!hn::AllFalse(f, may_turn)) {
    // Extrema: roots of 3 c3 u² + 2 c2 u + c1, by the form that does not cancel.
    const VF discriminant = hn::NegMulAdd(c33, c1, hn::Mul(c2, c2));
    const VF s = hn::Neg(hn::Add(c2, hn::CopySign(hn::Sqrt(hn::Max(discriminant, zero)), c2)));
    const VF u1 = hn::Div(s, hn::IfThenElse(hn::Eq(c33, zero), real(1e-30F), c33));
    const VF u2 = hn::Div(c1, hn::IfThenElse(hn::Eq(s, zero), real(1e-30F), s));
    const auto turnsAt = [&](VF u) {
      return hn::And(hn::Ge(discriminant, zero), hn::And(hn::Gt(u, zero), hn::Lt(u, one)));
    };
    const MF turn1 = turnsAt(u1), turn2 = turnsAt(u2);
    // There may be several roots if an extremum's sign differs from that of both ends, or if there are two extrema
    // between ends whose signs differ.
    const MF other1 = hn::And(turn1, hn::Xor(hn::Le(value(u1), zero), in_start));
    const MF other2 = hn::And(turn2, hn::Xor(hn::Le(value(u2), zero), in_start));
    several = hn::Or(hn::AndNot(crossing, hn::Or(other1, other2)), hn::And(crossing, hn::And(turn1, turn2)));
    several = hn::And(several, may_turn);
  }

  // Near zero at an end, rounding decides about the sign there: the cubic may have two roots where one seems to be.
  const VF rounding =
      hn::Mul(real(1e-6F), hn::Add(hn::Add(hn::Abs(c0), hn::Abs(c1)), hn::Add(hn::Abs(c2), hn::Abs(c3))));
  const MF doubtful = hn::Or(hn::Le(hn::Abs(c0), rounding), hn::Le(hn::Abs(at_end), rounding));
  several = hn::Or(several, hn::And(crossing, doubtful));

  // The only root of the other lanes that cross: by Newton's method within a shrinking bracket.
  VF lo = zero, hi = one;
  VF u = hn::Div(c0, hn::Sub(c0, hn::IfThenElse(crossing, at_end, hn::Add(c0, one))));
  const MF sought = hn::AndNot(several, crossing);
  MF loose = sought;
  for (int i = 0; i < 6 && !hn::AllFalse(f, loose); ++i) {
    const VF at = value(u);
    const VF slope = hn::MulAdd(u, hn::MulAdd(u, c33, hn::Add(c2, c2)), c1);
    const MF as_start = hn::Not(hn::Xor(hn::Le(at, zero), in_start));
    lo = hn::IfThenElse(as_start, u, lo);
    hi = hn::IfThenElse(as_start, hi, u);
    const VF newton = hn::Sub(u, hn::Div(at, slope));
    const MF good = hn::And(hn::Ge(newton, lo), hn::Le(newton, hi));
    const VF next = hn::IfThenElse(good, newton, hn::Mul(hn::Add(lo, hi), real(0.5F)));
    // After a step this short the next one would be lost in rounding. Such lanes do not change any more, so that no
    // lane's result depends on its neighbours.
    const VF step = hn::Abs(hn::Sub(next, u));
    u = hn::IfThenElse(loose, next, u);
    loose = hn::And(loose, hn::Gt(step, real(1e-4F)));
  }
  const VF t_root = hn::MulAdd(u, hn::Sub(t_exit, lanes.t), lanes.t);
  return {{c0, c1, c2, c3}, at_end, in_start, in_end, hn::Or(several, loose), t_root};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
