#pragma once

#include <string>

#include <visualization_msgs/MarkerArray.h>

#include "ros/bag/bag_writer.h"
#include "sdf_ccd/simulation.h"

namespace sdf_ccd {

/// Writes a simulation to a bag that rviz can play.
///
/// `/tf`: every body in the frame `scene` (the scene's frame O), which `/tf_static` puts into `world`.
/// `/simulation/bodies` (visualization_msgs/MarkerArray): the bodies' meshes, locked to their frames, with the stamp 0,
/// that is, at the newest transform. They are repeated every second for viewers that start late, and ten times a second
/// in the first half second for a viewer that plays the bag in a loop and deletes them when time jumps back. Time
/// begins at 1 s, as 0 means "no time" in ROS.
class SimulationBag {
 public:
  /// @param bag  open and empty; the caller closes it, and it must outlive this. Its functions throw if it cannot be
  ///             written.
  SimulationBag(BagWriter& bag, const SimulationSetup& setup);

  /// Writes the poses at `time` [s] of the simulation; the times must increase.
  void add(double time, const std::vector<BodyState>& states);

 private:
  BagWriter& bag_;
  std::vector<std::string> frames_;  // per body
  visualization_msgs::MarkerArray markers_;
  double next_markers_ = 0.0;  // [s]
};

}  // namespace sdf_ccd
