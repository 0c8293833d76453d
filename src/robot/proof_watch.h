#pragma once

#include <string>
#include <vector>

#include "robot/unreachable_pairs.h"

namespace sdf_ccd {

/// Why a pair is not checked that was left out because of the URDF, but that tf has elsewhere.
std::string contradictionOf(const UnreachablePair& pair);

/// Finds pairs that were left out because of how the URDF joins their links, but that a motion has elsewhere.
///
/// Pairs that are rigidly joined are compared at the waypoints; those out of reach of each other come within the sum of
/// their balls' radii at one, or between two. Between two waypoints a pair that moves as the URDF has it is never
/// reported; one that comes within reach on a curve is missed where the curve deviates from its chord by more.
class ProofWatch {
 public:
  /// @param scene  with the bodies of the pairs; both must outlive this.
  ProofWatch(const std::vector<UnreachablePair>& pairs, const SceneDescription& scene);

  /// @param spans  per pair: the part of the motion to look at, in which the poses of both bodies are known. Its first
  /// waypoint is the last one of the part before.
  /// @return per pair.
  const std::vector<char>& contradicted(const CycleMotion& motion, const std::vector<WaypointSpan>& spans);

 private:
  /// A body of pairs. Its ball's centre moves from one waypoint to the next.
  struct Watched {
    std::size_t body;
    BoundingBall ball;
    std::size_t group;  // first one of those that are rigidly joined to it
    Isometry3d X_GB = Isometry3d::Identity();
    std::vector<GeometryDescription> boxes = {};  // that contain an object of the world; empty for links
    Vector3d p_W_before = Vector3d::Zero(), p_W = Vector3d::Zero();
    double travel = 0.0;  // the distance between these [m]
  };
  struct Pair {
    std::size_t a, b;  // in watched_
    double reach;      // sum of the balls' radii [m]
    bool is_joined;
    const UnreachablePair* pair;
  };
  struct Step;  // from one waypoint to the next

  void join(const Pair& pair);
  void place(const CycleMotion& motion, std::size_t waypoint);
  bool areAllJoined(const CycleMotion& motion, std::size_t waypoint) const;
  bool areFarApart(const Pair& pair) const;
  bool mayMeet(const Pair& pair, const CycleMotion& motion, std::size_t waypoint) const;
  bool isApart(const Watched& object, const Watched& link, const Step& step) const;

  std::vector<Watched> watched_;
  std::vector<Pair> pairs_;
  bool any_joined_ = false, any_apart_ = false;
  double size_ = 0.0;  // bounds the distance of joined bodies' points from their group's origin [m]
  std::vector<char> contradicted_;
};

}  // namespace sdf_ccd
