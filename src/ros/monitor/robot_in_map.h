#pragma once

#include <map>
#include <string>
#include <vector>

#include "monitor/map/robot_masks.h"
#include "ros/world/checked_world.h"

namespace sdf_ccd {

/// Where the robot and the objects attached to it are in a map, according to tf.
///
/// The poses at the map's stamp tell which of its voxels are the robot's own; an object that was attached later had
/// none on its link. tf may know them only after the map was received; of a map that is older than the transforms it
/// never does. Poses at the stamp are kept once they are known, as tf forgets them after some seconds.
class RobotInMap {
 public:
  /// @param frame    carries the map.
  /// @param stamp    of the map; 0: it is not known when the map was made.
  /// @param max_gap  a pose is not known between transforms that are farther apart [s].
  RobotInMap(const TfHistory& history, std::string frame, const ros::Time& stamp, double max_gap)
      : history_(history), frame_(std::move(frame)), stamp_(stamp), max_gap_(max_gap) {}

  /// Looks up the poses; does not wait for any.
  void update(const CheckedWorld& world);

  /// The bodies of the last update whose poses are known.
  const std::vector<BodyInMap>& bodies() const { return bodies_; }

  /// Whether the transforms of some frame end before the stamp, by no more than this time [s].
  bool isAheadOfTf(double max_lag) const;

  /// Why not all poses at the stamp are known; empty if they are.
  const std::string& problem() const { return problem_; }

  /// Whether some pose of each body is known.
  bool isSomewhere() const { return without_pose_ == 0; }

  /// Number of bodies whose pose at the stamp is not known, plus those of which no pose is known at all.
  std::size_t unknown() const { return unknown_; }

 private:
  const Isometry3d* poseAtStamp(const std::string& frame);

  const TfHistory& history_;
  std::string frame_;
  ros::Time stamp_;
  double max_gap_;
  std::map<std::string, Isometry3d> X_W_at_stamp_;  // by frame
  std::vector<BodyInMap> bodies_;
  std::vector<double> lags_;  // per frame whose transforms end before the stamp: by how much [s]
  std::string problem_;
  std::size_t unknown_ = 0, without_pose_ = 0;
};

}  // namespace sdf_ccd
