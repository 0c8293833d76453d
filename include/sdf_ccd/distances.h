#pragma once

#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// Width of the gap between two bodies and the speed at which it closes, as measured in one of two ways.
struct ClosingGap {
  double width = 0.0;  ///< lower bound of the distance of the bodies [m]
  double closing =
      0.0;            ///< upper bound of the mean speed at which `width` decreases over `over` [m/s]; may be negative
  double over = 0.0;  ///< period that ends at the distance's time [s]; at least the time between two recorded poses
};

/// Facts about a cycle that its motion does not contain.
struct CycleRecord {
  std::chrono::nanoseconds origin{0};  ///< the cycle's time 0, since the clock's epoch
  /// Per body: the longest time between two recorded poses, summed over the transforms of its chain [s]; null: unknown.
  const std::vector<double>* gaps = nullptr;
  bool single_pose_is_fixed = false;  ///< bodies with a single pose never move: they are not only at rest in this cycle
};

/// Distance of two bodies at one time: the last time at which both are known in the cycle.
struct PairDistance {
  int pair = -1;  ///< in Scene::pairs
  int body_a = -1, body_b = -1;
  bool is_with_map = false;  ///< one body is a tile of a map
  /// Neither body ever moves (CycleRecord::single_pose_is_fixed), nor is a tile, which the next map may change.
  bool is_constant = false;
  double time = 0.0;      ///< [s] from t₀ of the last cycle; negative for a delayed pair
  double distance = 0.0;  ///< [m]; 0 if the bodies touch at that time
  double error = 0.0;     ///< upper bound of the error of `distance` [m]
  Vector3d p_A_W = Vector3d::Zero(), p_B_W = Vector3d::Zero();  ///< witness points on A and on B [m]
  Vector3d normal_W = Vector3d::Zero();  ///< unit, from A to B; zero if the bodies touch and it is not known
  double closing_speed = 0.0;            ///< of the witness points along the normal, mean over the last step [m/s]
  ClosingGap any;  ///< in any direction: bounded by the fastest point of either body relative to the other
  std::optional<ClosingGap> slab;  ///< along the normal, if a separating slab between the bodies is known
};

/// Distances of nearby pairs over cycles, each with the witness points at which the bodies are nearest: exact up to the
/// deviation of Body::triangles.
///
/// A pair that the monitor knows to be beyond the range costs some nanoseconds per cycle, another one some
/// microseconds. Memory is allocated only if more pairs are near each other than ever before.
class PairDistances {
 public:
  /// Of a scene about which nothing is measured yet.
  explicit PairDistances(std::shared_ptr<const Scene> scene);
  ~PairDistances();

  /// Processes a cycle of the scene. @param range  pairs that are certainly farther apart are not listed [m].
  /// @param result  must hold the clearances of all pairs (CycleRequest::skipped_pairs).
  /// @param record  of the motion. Cycles may overlap in time, when delayed pairs are checked later.
  const std::vector<PairDistance>& update(const CycleMotion& motion, const CycleResult& result, double range,
                                          const CycleRecord& record);

  /// In the order of Scene::pairs. Pairs that are not checked are not listed; delayed pairs keep their last entry.
  const std::vector<PairDistance>& near() const;

  /// Whether a pair is delayed that was not known to be beyond the range before: it is not listed, and its distance is
  /// unknown.
  bool hasUnknown() const;

  /// Discards all measurements, as when cycles were left out. Costs nothing if there are none.
  void forget();

  /// Continues from the distances of another scene between two cycles, and leaves those empty: a nearby pair that both
  /// scenes have stays listed until it is measured again. Only delayed pairs need it.
  /// @param pairs_now  per pair of the other scene: its index in this one; −1 if it has none.
  void continueFrom(PairDistances& before, const std::vector<int>& pairs_now);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a pair of a scene can do, and how near it may come. The default is the one that limits most.
struct PairTraits {
  bool is_own = false;       ///< both bodies are links of the robot, or what these hold
  bool is_constant = false;  ///< their distance cannot change, whatever the joints do
  double max_closing =
      std::numeric_limits<double>::infinity();  ///< speed at which it can close with all joints at their limits [m/s]
  std::optional<double> stop_distance = {};     ///< [m]; none: that of all pairs
};

/// How pairs of the robot's own links limit the velocity scale.
enum class OwnPairs {
  kMeasured,  ///< by the speed at which they close as measured: measuredScale(), which proves nothing
  kPromise,   ///< as pairs with the world: allowedClosing(), if no joint is faster than the scale times its limit
};

/// What a robot that obeys a velocity scale promises, and what it is promised in turn: no pair with the world and,
/// with OwnPairs::kPromise, no pair of its own links comes closer than the stop distance. All of it holds only if
/// nothing but the robot moves. Speeds are those of the fastest point of a body relative to another one, in any
/// direction.
struct StoppingPromise {
  double max_speed = 1.0;         ///< V: upper bound of the speed at scale 1 [m/s]
  double max_acceleration = 5.0;  ///< A: upper bound of the rate at which a speed grows, in any direction [m/s²]
  /// a: speeds above scale × V decrease at least by this [m/s²], in any direction, and those below do not come to
  /// exceed it: while it brakes, a point that is still faster does not turn towards a body.
  double deceleration = 2.0;
  double reaction_time = 0.1;  ///< R: the robot obeys a scale at most this long after it is published [s]
  double period = 0.1;         ///< P: if no scale comes for this long, the robot acts as on a scale of 0 [s]
  double stop_distance = 0.0;  ///< d: no pair may come closer than this [m]; PairTraits can say otherwise
  /// d of pairs with a tile of a map, if that is more [m]: nearer to the robot, its voxels are ignored.
  double map_distance = 0.0;
  double max_age = 0.2;  ///< older data counts as unknown [s]
  OwnPairs own_pairs = OwnPairs::kMeasured;
};

/// The largest closing speed of a gap, from when the robot obeys, at which the gap never becomes narrower than the stop
/// distance [m/s]; 0: the robot must brake as hard as promised.
/// @param age  of the gap's data, when the scale is published [s].
///
/// Guarantee. Let w(t) be the gap's true width minus d, and c(t) its largest closing speed along its direction, ẇ ≥
/// −c. Both bodies move only as the robot moves them. Let t_k be the time of the gap's data and t_k + T_k, with
/// T_k = age + R, the time at which the robot obeys the scale s_k; it obeys the next scale at most P later. Then w
/// never becomes negative if at some time this holds:
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
/// held before, because the robot brakes. For a pair beyond scaleRange(), (1) gives u ≥ V. A pair that closes at scale
/// 1 by at most V′ < V closes at a scale s by at most s V′: the proof holds with V′ for V, and the scale is u / V′.
///
/// What it needs of the world: a body that moves on its own closes the gap by more than c, and then nothing is
/// promised.
double allowedClosing(const ClosingGap& gap, double age, const StoppingPromise& promise);

/// The scale for a pair of the robot's own links under OwnPairs::kMeasured: 1 if the pair rests or opens, 0 within its
/// stop distance. The scale applies to whatever motion follows, so what a pair at rest *can* do says nothing about what
/// it will do; a wrist's gap of 20 mm would stop the robot for ever.
///
/// Let v be the speed from which the robot can still stop before the stop distance: v (age + R + P) + v²/2a = w − d. A
/// pair that closes at c under a scale s would close by C = c / s at scale 1 (no more than by V); it is given ⅔ v / C,
/// at most 1. The third is for what is measured late while the gap becomes narrower.
///
/// This is no proof of a distance: a pair that rests closer than it can stop in, and is then accelerated towards each
/// other, is found closing only after age + R.
/// @param closing  as measured, may be negative [m/s].
/// @param scale    the one that the robot obeyed when that was measured, or a smaller one.
double measuredScale(double width, double closing, double scale, double age, const StoppingPromise& promise);

/// Pairs that are certainly farther apart than this do not limit the scale [m].
/// @param stop_distance  the largest of all pairs [m].
double scaleRange(const StoppingPromise& promise, double stop_distance);

/// Where a pair that can close at `max_speed` is closer than this, a robot at rest is given 0, even by data without age
/// [m].
double standstillDistance(const StoppingPromise& promise, double stop_distance, double max_speed);

/// A scale, and what limits it.
struct ScaleLimit {
  double scale = 0.0;
  std::optional<PairDistance> pair;  ///< that limits it; none: none does, or the data are too old
};

/// The largest scales in [0, 1] for a cycle, by what they rest on.
struct ScaleLimits {
  ScaleLimit promised;  ///< keeps pairs apart by allowedClosing()
  ScaleLimit measured;  ///< by measuredScale()
};

/// @param traits  per pair of the scene; empty: all are pairs with the world, and can change.
/// @param age     of the last cycle's start t₀ [s]; the age of a pair's data is this minus PairDistance::time.
/// @param oldest  age of the oldest data of any pair, including pairs beyond scaleRange() that are not listed [s].
/// @param obeyed  as measuredScale()'s scale.
ScaleLimits velocityScales(const std::vector<PairDistance>& pairs, const std::vector<PairTraits>& traits, double age,
                           double oldest, double obeyed, const StoppingPromise& promise);

/// The scales that were published, as far as measured ones need them.
///
/// What is measured was caused by a scale published within the last max_age + R + P. As it is not known by which, the
/// smallest counts, so that C is not underestimated. A measured scale falls at once,
/// and rises by a factor of e in twice that time, no faster: then C is overestimated by no more than √e while it rises,
/// and before a rise shows in what is measured, the pair closes by no more than ⅔ √e v, about 1.1 v.
class PublishedScales {
 public:
  /// The smallest scale of the last max_age + R + P; 1 if there is none.
  double obeyed(double time, const StoppingPromise& promise) const;

  /// @return what a measured scale of the present cycle may be. @param time  on any clock [s].
  ScaleLimit limitRise(const ScaleLimit& measured, double time, const StoppingPromise& promise);

  /// To be called when the scene has changed: pairs have other indices. The scales stay.
  void forgetPair() { measured_.pair.reset(); }

  /// To be called with each scale that is published.
  void add(double scale, double time, const StoppingPromise& promise);

 private:
  struct Published {
    double time, scale;
  };
  std::vector<Published> published_;  // the oldest first
  ScaleLimit measured_{1.0, {}};      // the last one
  double time_ = 0.0;                 // of it
};

}  // namespace sdf_ccd
