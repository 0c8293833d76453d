#pragma once

#include <string>

#include <visualization_msgs/MarkerArray.h>

#include "ros/bag/bag_writer.h"
#include "sdf_ccd/dynamics/simulation.h"

namespace sdf_ccd {

/// Writes a simulation to a bag that rviz shows as it moves.
///
/// `/tf`: every body in the frame `scene` (the scene's frame O), which `/tf_static` puts into `world`.
/// `/simulation/bodies` (visualization_msgs/MarkerArray): the bodies' meshes, locked to their frames, with the stamp 0:
/// wherever the frames are by the newest transform. Repeated every second, so that a viewer that comes late gets them,
/// and ten times a second in the first half second, so that one that plays the bag in a loop and forgets them when time
/// jumps back gets them again. Time begins at 1 s, as 0 means "no time" to ROS.
class SimulationBag {
 public:
  /// @param bag  open, and empty; closed by whoever opened it, and must outlive this. It throws where it cannot be
  ///             written.
  SimulationBag(BagWriter& bag, const SimulationSetup& setup);

  /// Poses at `time` [s] of the simulation; call with times that increase.
  void add(double time, const std::vector<BodyState>& states);

 private:
  BagWriter& bag_;
  std::vector<std::string> frames_;  // per body
  visualization_msgs::MarkerArray markers_;
  double next_markers_ = 0.0;  // [s]
};

}  // namespace sdf_ccd
