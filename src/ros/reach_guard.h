#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ros/describe_scene.h"
#include "ros/tf_tracker.h"

namespace sdf_ccd {

/// Watches what pairs that were left out as out of reach rest on: that prismatic joints keep to their limits, by and
/// large (RobotModel::reach()).
class ReachGuard {
 public:
  explicit ReachGuard(const DescribedScene& described);

  /// The pairs that this does not hold for at some recorded time of the cycle, or whose joints tf does not have.
  std::vector<UncheckedPair> check(const TfHistory& history, const TrackedCycle& cycle);

 private:
  struct Joint {
    RobotModel::Slide slide;
    const urdf::Joint* joint;
    std::string problem;  // in the last cycle
  };

  void follow(const TfHistory& history, const TrackedCycle& cycle);
  std::string problem(std::size_t joint, const TrackedCycle& cycle);

  std::shared_ptr<const RobotModel> robot_;
  std::vector<Joint> joints_;
  TfChains chains_;  // to each joint's parent and child
  std::vector<TfSpan> spans_;
  std::vector<TimePart> parts_;
  TfWindow window_;
  std::vector<UncheckedPair> pairs_;               // each with no reason yet
  std::vector<std::vector<std::size_t>> rest_on_;  // per pair: joints
};

}  // namespace sdf_ccd
