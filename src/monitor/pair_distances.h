#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "query/separation.h"
#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {

/// How wide a gap between two bodies is, and how fast it closes: two ways to look at a pair.
struct ClosingGap {
  double width = 0.0;  ///< lower bound of the bodies' distance [m]
  double closing =
      0.0;            ///< upper bound of the mean speed at which that becomes less over `over` [m/s]; may be negative
  double over = 0.0;  ///< up to the time of the distance [s]; not less than what lies between two recorded poses
};

/// What a cycle's motion does not tell itself.
struct CycleRecord {
  std::chrono::nanoseconds origin{0};  ///< its time 0, since the clock's epoch
  /// Per body: longest time between two recorded poses, summed over all that these are made of; null: none [s].
  const std::vector<double>* gaps = nullptr;
};

/// How far two bodies are apart at one time: the end of what is known of them in the cycle.
struct PairDistance {
  int pair = -1;  ///< in Scene::pairs
  int body_a = -1, body_b = -1;
  double time = 0.0;      ///< [s] from t₀ of the last cycle; before it for a pair that is delayed
  double distance = 0.0;  ///< [m]; 0 of bodies that touch at that time
  double error = 0.0;     ///< the true distance is nowhere farther off than this [m]
  Vector3d p_A_W = Vector3d::Zero(), p_B_W = Vector3d::Zero();  ///< the witness points: on A and on B [m]
  Vector3d normal_W = Vector3d::Zero();  ///< unit, from A to B; zero if bodies touch and it is not known
  double closing_speed = 0.0;            ///< of the witness points along the normal, mean over the last step [m/s]
  ClosingGap any;                        ///< by the fastest point of either body, as seen from the other
  std::optional<ClosingGap> slab;        ///< along the normal, where a slab between the bodies is known
};

/// Distances of pairs that are near each other, over cycles, each with witness points: where it is nearest on both
/// bodies. Of bodies that are all triangles exact, but for Body::triangles' deviation; of others by the points of one's
/// shell and the other's field, with the field's error and the gap between points.
///
/// Pairs that cannot have come near since they were looked at last cost some nanoseconds a cycle each, others some
/// microseconds. Nothing is allocated per cycle but for more pairs near each other than ever before.
class PairDistances {
 public:
  explicit PairDistances(std::shared_ptr<const Scene> scene);

  /// Takes a cycle of the scene. @param range  pairs that surely are farther apart are not listed [m].
  /// @param result  with the clearances of all pairs (CycleRequest::skipped_pairs).
  /// @param record  of the motion; cycles may overlap, as pairs are caught up on.
  const std::vector<PairDistance>& update(const CycleMotion& motion, const CycleResult& result, double range,
                                          const CycleRecord& record);

  /// In the order of Scene::pairs; pairs that are not checked are not listed, those that are delayed as they were.
  const std::vector<PairDistance>& near() const { return near_; }

  /// Whether some pair is delayed of which it was not known before whether it is within the range: it is not listed,
  /// and may be anywhere.
  bool hasUnknown() const { return has_unknown_; }

  /// As where cycles are left out. Costs nothing if nothing is known.
  void forget();

  /// Goes on from another scene's, between two cycles, and leaves it empty: what was near there, and is the same pair
  /// here, stays known until it is measured. Only pairs that are delayed need it.
  /// @param pairs_now  per pair there: the same pair here; −1 if there is none.
  void take(PairDistances& before, const std::vector<int>& pairs_now);

 private:
  static constexpr double kNowhere = -1.0;  // below any range

  struct Pair {
    double known_within = kNowhere;  // range of the last measurement [m]
    bool is_known = false;
    double at_least = 0.0;  // the distance at X_FP [m]
    Isometry3d X_FP = Isometry3d::Identity();
    SeparationWitness witness;
    PairDistance last;  // valid if is_near
    bool is_near = false;
  };

  bool isFar(std::size_t pair, const PairResult& result, const Isometry3d& X_FP, double range);
  void measure(std::size_t pair, const CycleMotion& motion, const PairResult& result, double range,
               const CycleRecord& record);
  bool findNearest(std::size_t pair, const Isometry3d& X_WA, const Isometry3d& X_WB, double range, PairDistance& found);
  bool nearestOfSurfaces(std::size_t pair, const Isometry3d& X_WA, const Isometry3d& X_WB, double range,
                         PairDistance& found);
  bool nearestOfShell(int shell_body, int field_body, bool shell_is_a, const Isometry3d& X_WF, const Isometry3d& X_WP,
                      double range, PairDistance& found);

  /// How P moves against F from one waypoint to the next, `last`.
  struct Step {
    bool f_is_a;
    Isometry3d X_then, X_now;
    const BoundingBall& ball;  // of P
  };
  Step stepOf(const CycleMotion& motion, std::size_t last, int body_a, int body_b) const;
  double travelSince(double time, const CycleMotion& motion, const PairResult& result) const;
  void setSpeeds(const CycleMotion& motion, const WaypointSpan& span, const CycleRecord& record,
                 PairDistance& found) const;

  std::shared_ptr<const Scene> scene_;
  std::vector<Pair> pairs_;
  std::vector<PairDistance> near_;
  std::chrono::nanoseconds origin_{0};  // of the last cycle
  bool has_unknown_ = false;
  bool is_empty_ = true;  // nothing is known
  SeparationMemory memory_;
  std::vector<int> pending_;
};

}  // namespace sdf_ccd
