#pragma once

#include <chrono>
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
};

/// Distance of two bodies at one time: the last time at which both are known in the cycle.
struct PairDistance {
  int pair = -1;  ///< in Scene::pairs
  int body_a = -1, body_b = -1;
  bool is_with_map = false;  ///< one body is a tile of a map
  /// No moving transform is in the chain of either body, and neither is a tile, which the next map may change.
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
  void take(PairDistances& before, const std::vector<int>& pairs_now);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sdf_ccd
