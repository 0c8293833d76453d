#pragma once

#include <vector>

#include "sdf_ccd/scene.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// Finds pairs that a scene leaves out because their bodies do not move relative to each other (PairKind::kRigid),
/// but that a motion has elsewhere: points in the ball around one of them by more than a millimetre, as seen from the
/// other. Robots as calibrated differ by less from their URDF.
///
/// Usually each body is compared once, with the first of those that are rigidly joined to it.
class RigidWatch {
 public:
  explicit RigidWatch(const Scene& scene);

  /// None of them is tested.
  const std::vector<PlannedPair>& pairs() const { return pairs_; }

  /// Compares the poses at the waypoints. Two bodies that are rigidly joined there are so between them, too.
  /// @param spans  per pair, as CycleMotion::spans; none: all of the motion. Bodies that are missing are not compared.
  /// @param moved  per pair: set where it is elsewhere, else left as it is.
  void find(const CycleMotion& motion, const std::vector<WaypointSpan>& spans, std::vector<char>& moved) const;

 private:
  /// A body of pairs.
  struct Watched {
    std::size_t body;
    BoundingBall ball;  // infinite for a half-space
    std::size_t group;  // in watched_: the first one of those that are rigidly joined to it
    Isometry3d X_GB = Isometry3d::Identity();
  };
  struct Joint {
    std::size_t a, b;  // in watched_
    Isometry3d X_AB;
  };

  void join(const Joint& joint);
  bool areAllJoined(const CycleMotion& motion, std::size_t waypoint) const;
  bool isJoined(const Joint& joint, const CycleMotion& motion, std::size_t waypoint) const;

  std::vector<PlannedPair> pairs_;
  std::vector<Joint> joints_;  // per pair
  std::vector<Watched> watched_;
  double size_ = 0.0;  // bounds the distance of bodies' points from their group's origin [m]
};

}  // namespace sdf_ccd
