#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "robot/joint_states.h"
#include "sdf_ccd/monitor.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// How two links are in one state of the robot.
enum class Nearness {
  kApart,
  kNear,     ///< apart, by no more than a given distance
  kOpen,     ///< they may overlap: surfaces coincide or nearly so, or the inside of one is not known
  kHeld,     ///< neighbours (RobotModel::neighbours()) whose surfaces are within 1 mm, as a joint holds them together
  kOverlap,  ///< their shapes certainly overlap
  kUnknown   ///< not checked
};

/// How two links are in all states in which they were tested.
enum class Together {
  kUnknown,    ///< some could not be checked
  kAlways,     ///< they overlap, or are held together, in each of them. Not if they were held in some states and enter
               ///< each other by more in others: they are not held together by their joint, but hit a stop
  kSometimes,  ///< they overlap in some
  kClose,      ///< they come near, or may overlap
  kNever
};

/// Two links in many states of the robot.
class ObservedPair {
 public:
  Nearness at_rest = Nearness::kUnknown;        ///< with all joints at zero, or at the nearest limit
  Verdict rest_verdict = Verdict::kNotChecked;  ///< the monitor's in that state
  double rest_depth = 0.0;  ///< if they overlap there: of the deepest point found [m]; 0 if only surfaces show it

  void add(Nearness nearness, const JointPositions& state);
  bool has(Nearness nearness) const { return (seen_ >> static_cast<int>(nearness) & 1U) != 0; }

  Together together() const;

  /// Whether they are CONTACT or UNCERTAIN at rest, for the monitor.
  bool mayOverlapAtRest() const { return mayTouch(rest_verdict); }

  std::size_t tested = 0;  ///< number of states in which they were tested
  bool hits_stop = false;
  std::vector<JointPositions> overlaps;  ///< some of the states in which they overlap

 private:
  unsigned seen_ = 0;  ///< a bit for each Nearness
};

/// The states in which pairs are observed: rest, the recorded ones, then random ones of a JointSampler.
struct Observation {
  const JointStates* recorded = nullptr;
  std::size_t random_states = 200;
  std::uint64_t seed = 1;
  double near = 0.0;  ///< for Nearness::kNear [m]

  /// Whether another state can change what the caller concludes from a pair. @param pair  in Scene::pairs.
  /// @param random  number of random states so far.
  std::function<bool(std::size_t pair, const ObservedPair& observed, std::size_t random)> is_open;
  std::function<void(double share)> progress = {};  ///< may throw to cancel
};

/// Observes pairs of a scene, in their order, each until it is no longer open; parallel over the states. The result
/// does not depend on the number of threads.
/// @param pairs  in Scene::pairs, of links: a link's body has its name, and its frame.
std::vector<ObservedPair> observePairs(const RobotModel& robot, const Scene& scene,
                                       const std::vector<std::size_t>& pairs, const Observation& observation);

}  // namespace sdf_ccd
