#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "clearance_table.h"
#include "motion/two_body_motion.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// Exact motion of a scene's bodies during one cycle, computed once per body for all of its pairs that are tested.
/// Between two times a body moves with a constant twist in the world.
class SweptBodies {
 public:
  explicit SweptBodies(const Scene& scene) : scene_(scene), bodies_(scene.bodies.size()) {
    taken_.reserve(scene.bodies.size());
  }

  /// Sets a cycle's motion, for the bodies of due pairs and the times that the spans of these pairs need.
  /// @param pairs  all pairs of the scene.
  void sweepDue(const CycleMotion& motion, const std::vector<PairResult>& pairs, const std::vector<DuePair>& due);

  /// Why a body's motion cannot be followed: a pose is not finite, not a rotation, or too far away. Empty if it can.
  const std::string& problem(int body) const { return bodies_[body].problem; }

  /// Why a body's motion is not known in a cycle: it could not be built, its transforms are missing, or problem().
  /// Empty if it is known.
  const std::string& whyUnknown(const CycleMotion& motion, int body) const {
    const std::string& failure = scene_.bodies[body].failure;
    if (!failure.empty()) return failure;
    const bool is_lost = !motion.missing.empty() && !motion.missing[body].empty();
    return is_lost ? motion.missing[body] : problem(body);
  }

  const std::vector<double>& times() const { return *times_; }

  /// Motion between times `waypoint` and waypoint + 1; problem() must be empty.
  const ScrewMotion& screw(int body, std::size_t waypoint) const { return at(body, waypoint).screw; }
  const WorldTwist& twist(int body, std::size_t waypoint) const { return at(body, waypoint).twist; }

  /// Error of a point from computing with the body's poses [m]: the deviation of the rotations from orthonormal ones
  /// (times the distance `lever` [m] from the body's origin and, as poses between two times are relative to the first
  /// one, that by which the origin moves), and the rounding of the coordinates.
  double poseError(int body, double lever) const {
    const SweptBody& swept = bodies_[body];
    return swept.defect * (lever + swept.moved) + swept.rounding;
  }

 private:
  struct Interval {
    ScrewMotion screw;
    WorldTwist twist;
  };
  struct SweptBody {
    bool is_taken = false;            ///< a due pair needs it
    std::size_t first = 0, last = 0;  ///< range of the times needed
    std::vector<Interval> intervals;  ///< from time `first` on; one if the body has a single pose
    std::string problem;
    double defect = 0.0;    ///< largest |RᵀR − 1| of its poses, with rounding
    double rounding = 0.0;  ///< of the poses' translations [m]
    double moved = 0.0;     ///< most that the origin moves in an interval [m]
  };

  void sweep(const CycleMotion& motion, int body);
  const Interval& at(int body, std::size_t waypoint) const {
    const SweptBody& swept = bodies_[body];
    return swept.intervals[std::min(waypoint - swept.first, swept.intervals.size() - 1)];
  }

  const Scene& scene_;
  std::vector<SweptBody> bodies_;
  std::vector<int> taken_;
  const std::vector<double>* times_ = nullptr;
};

}  // namespace sdf_ccd
