#pragma once

#include <vector>

#include "monitor/pair_distances.h"

namespace sdf_ccd {

/// What a robot promises that obeys a velocity scale. Speeds are those of the fastest point of a body as seen from
/// another one, in any direction; the robot alone moves.
struct StoppingPromise {
  double max_speed = 1.0;         ///< V: none is faster at scale 1 [m/s]
  double max_acceleration = 5.0;  ///< A: no speed grows faster, in any direction [m/s²]
  double deceleration = 2.0;      ///< a: speeds above scale × V become less by this at least [m/s²]
  double reaction_time = 0.1;     ///< R: so long after a scale is published the robot obeys it at the latest [s]
  double period = 0.1;            ///< P: where no scale has come for as long, it reacts as to a scale of 0 [s]
  double stop_distance = 0.0;     ///< d: no pair shall come nearer than this [m]
  double max_age = 0.2;           ///< what is older than this is taken as not known [s]
};

/// @throws std::invalid_argument, with the value.
void validate(const StoppingPromise& promise);

/// The fastest that a gap may close from when the robot obeys, so that it never becomes narrower than the stop
/// distance; 0: it must brake as hard as promised.
/// @param age  of what is known of the gap, when the scale is published [s].
///
/// What it guarantees. Let w(t) be the true width of the gap less d, and c(t) the largest closing speed of it along the
/// gap's direction, ẇ ≥ −c. With t_k the time that the gap is known at and t_k + T_k, T_k = age + R, that when the
/// robot obeys the scale s_k, until it obeys the next one no later than P afterwards. Then w never becomes negative if
/// it holds at some time that  J: w ≥ c²/2a  (as of a robot that rests, and is not yet nearer than d).
///
/// Proof. At t_k + T_k the closing speed is at most ĉ = ċ_k + A T_k, with ċ_k what is known of it at t_k (a mean speed
/// over a time τ tells the speed at its end to A τ / 2, as |v(t) − mean| ≤ 1/τ ∫ A (t − s) ds), and the width at least
///   m = w_k − ĉ T_k.
/// u = s_k V is chosen so:
///  (1) m ≥ ĉ P + ĉ²/2a: the largest u with u P + u²/2a ≤ m, which is ĉ or more;
///  (2) else: u = (m − ĉ²/2a) / P, or 0 if that is negative; less than ĉ.
/// J holds then from when the robot obeys this scale until it obeys the next one, if it held before. Until t_k + T_k
/// w ≥ m, which is ĉ²/2a or more, or u = 0 and it brakes. From then on, let c₀ ≤ ĉ be the speed at t_k + T_k.
///  - While c > u, it falls by a per second: w − c²/2a does not fall, as its rate is at least −c + c a / a. J stays.
///  - From c ≤ u on, it stays so. Where c₀ ≤ u: all along w ≥ m − u P, which is u²/2a or more in (1); in (2) it is
///    ĉ²/2a, and u < ĉ. So J holds. Where c₀ > u > 0, which is in (2): to come down to u took c₀²/2a − u²/2a of the width at
///    most, so m − ĉ²/2a + u²/2a = u P + u²/2a is left, or more, and after P at speeds up to u still u²/2a. So J holds.
///    Where u = 0: J stays till it rests.
/// Beyond P without a scale, the robot brakes: J stays. And J says w ≥ 0. Gaps along several directions are looked at,
/// and the largest u of them is taken: J holds for that one, or, where all are 0, as it brakes, for that for which it
/// held before. A pair beyond scaleRange() has (1) with u ≥ V.
double allowedClosing(const ClosingGap& gap, double age, const StoppingPromise& promise);

/// Pairs that surely are farther apart than this do not limit the scale [m].
double scaleRange(const StoppingPromise& promise);

/// The largest scale in [0, 1] that keeps all pairs apart.
/// @param age     of the last cycle's start, t₀ [s]; of a pair: less its PairDistance::time.
/// @param oldest  of what is known of any pair, those included that are not listed as they are beyond scaleRange() [s]
double velocityScale(const std::vector<PairDistance>& pairs, double age, double oldest, const StoppingPromise& promise);

}  // namespace sdf_ccd
