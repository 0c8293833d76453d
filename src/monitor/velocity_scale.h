#pragma once

#include <vector>

#include "monitor/pair_distances.h"

namespace sdf_ccd {

/// What a robot that obeys a velocity scale promises. Speeds are those of the fastest point of a body relative to
/// another one, in any direction; only the robot moves.
struct StoppingPromise {
  double max_speed = 1.0;         ///< V: upper bound of the speed at scale 1 [m/s]
  double max_acceleration = 5.0;  ///< A: upper bound of the rate at which a speed grows, in any direction [m/s²]
  /// a: speeds above scale × V decrease at least by this [m/s²], in any direction, and those below do not come to
  /// exceed it: while it brakes, a point that is still faster does not turn towards a body.
  double deceleration = 2.0;
  double reaction_time = 0.1;  ///< R: the robot obeys a scale at most this long after it is published [s]
  double period = 0.1;         ///< P: if no scale comes for this long, the robot acts as on a scale of 0 [s]
  double stop_distance = 0.0;  ///< d: no pair may come closer than this [m]
  /// d of pairs with a tile of a map, if that is more [m]: nearer to the robot, its voxels are ignored.
  double map_distance = 0.0;
  double max_age = 0.2;  ///< older data counts as unknown [s]
};

/// The largest closing speed of a gap, from when the robot obeys, at which the gap never becomes narrower than the stop
/// distance [m/s]; 0: the robot must brake as hard as promised.
/// @param age  of the gap's data, when the scale is published [s].
///
/// Guarantee. Let w(t) be the gap's true width minus d, and c(t) its largest closing speed along its direction, ẇ ≥
/// −c. Let t_k be the time of the gap's data and t_k + T_k, with T_k = age + R, the time at which the robot obeys the
/// scale s_k; it obeys the next scale at most P later. Then w never becomes negative if at some time this holds:
///  J: w ≥ c²/2a (true for a robot at rest that is not closer than d).
///
/// Proof. At t_k + T_k the closing speed is at most ĉ = ċ_k + A T_k, where ċ_k bounds the speed at t_k (a mean speed
/// over a time τ gives the speed at its end up to A τ / 2, because |v(t) − mean| ≤ 1/τ ∫ A (t − s) ds), and
/// the width is at least
///   m = w_k − ĉ T_k.
/// The function chooses u = s_k V as follows:
///  (1) if m ≥ ĉ P + ĉ²/2a: the largest u with u P + u²/2a ≤ m, which is at least ĉ;
///  (2) else: u = (m − ĉ²/2a) / P, or 0 if that is negative; this is less than ĉ.
/// If J held before, it holds while the robot obeys this scale, until it obeys the next one. Until t_k + T_k, w ≥ m,
/// and either m ≥ ĉ²/2a, or u = 0 and the robot brakes. After that, let c₀ ≤ ĉ be the speed at t_k + T_k.
///  - While c > u, c decreases by a per second. The rate of w − c²/2a is then at least −c + c a / a = 0, so J is
///    kept.
///  - Once c ≤ u, it stays so. If c₀ ≤ u: w ≥ m − u P all the time. In (1) this is at least u²/2a; in (2) it
///    is ĉ²/2a, and u < ĉ. So J holds. If c₀ > u > 0, which happens only in (2): decelerating to u uses at most
///    c₀²/2a − u²/2a of the width, so at least m − ĉ²/2a + u²/2a = u P + u²/2a remains, and after P at
///    speeds up to u still u²/2a. So J holds. If u = 0: J is kept until the robot rests.
/// If no scale comes for P, the robot brakes and J is kept. J implies w ≥ 0. If a pair has gaps along several
/// directions, the largest of their u is used: J then holds for that gap or, if all u are 0, for the gap for which it
/// held before, because the robot brakes. For a pair beyond scaleRange(), (1) gives u ≥ V.
double allowedClosing(const ClosingGap& gap, double age, const StoppingPromise& promise);

/// Pairs that are certainly farther apart than this do not limit the scale [m].
double scaleRange(const StoppingPromise& promise);

/// The largest scale in [0, 1] that keeps all pairs apart.
/// @param age     of the last cycle's start t₀ [s]; the age of a pair's data is this minus PairDistance::time.
/// @param oldest  age of the oldest data of any pair, including pairs beyond scaleRange() that are not listed [s].
double velocityScale(const std::vector<PairDistance>& pairs, double age, double oldest, const StoppingPromise& promise);

}  // namespace sdf_ccd
