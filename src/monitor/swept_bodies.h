#pragma once

#include <string>
#include <vector>

#include "clearance_table.h"
#include "sdf_ccd/monitor/monitor.h"
#include "sdf_ccd/motion/two_body_motion.h"

namespace sdf_ccd {

/// How bodies of a scene move during one cycle, exactly: each worked out once, for all of its pairs that are tested.
/// Between two times a body moves with a constant twist in the world.
class SweptBodies {
 public:
  explicit SweptBodies(const Scene& scene) : scene_(scene), bodies_(scene.bodies.size()) {
    taken_.reserve(scene.bodies.size());
  }

  /// Takes a cycle's motion: of each body the times that the spans of its pairs need, of those that are due.
  /// @param pairs  all of the scene's.
  void take(const CycleMotion& motion, const std::vector<PairResult>& pairs, const std::vector<DuePair>& due);

  /// Why a body's motion cannot be followed: a pose that is not finite, no rotation, or too far away. Empty if it can.
  const std::string& problem(int body) const { return bodies_[body].problem; }

  const std::vector<double>& times() const { return *times_; }

  /// Between times `waypoint` and waypoint + 1, of a body that can be followed.
  const ScrewMotion& screw(int body, std::size_t waypoint) const { return at(body, waypoint).screw; }
  const WorldTwist& twist(int body, std::size_t waypoint) const { return at(body, waypoint).twist; }

  /// What computing with the body's poses adds to the error of a point [m]: by rotations that are none to rounding
  /// (at a distance `lever` [m] from the body's origin), and by the size of its coordinates.
  double poseError(int body, double lever) const { return bodies_[body].defect * lever + bodies_[body].rounding; }

 private:
  struct Interval {
    ScrewMotion screw;
    WorldTwist twist;
  };
  struct SweptBody {
    bool is_taken = false;            ///< some pair needs it
    std::size_t first = 0, last = 0;  ///< times that are needed
    std::vector<Interval> intervals;  ///< from `first` on
    std::string problem;
    double defect = 0.0;    ///< largest |RᵀR − 1| of its poses
    double rounding = 0.0;  ///< of its coordinates [m]
  };

  void sweep(const CycleMotion& motion, int body);
  const Interval& at(int body, std::size_t waypoint) const {
    return bodies_[body].intervals[waypoint - bodies_[body].first];
  }

  const Scene& scene_;
  std::vector<SweptBody> bodies_;
  std::vector<int> taken_;
  const std::vector<double>* times_ = nullptr;
};

}  // namespace sdf_ccd
