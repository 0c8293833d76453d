#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include "monitor/voxel_map.h"
#include "ros/messages/octomap_message.h"
#include "ros/monitor/scene_editor.h"

namespace sdf_ccd {

/// A voxel map that is received on a topic, as tiles of the world. Each map replaces the last one; unchanged tiles are
/// shared. While one map is processed the newest one waits, and others are dropped.
///
/// Before the first map, and while the last one is too old, the robot is NOT_CHECKED against the map.
///
/// Voxels that the robot and the objects attached to it occupy at the map's stamp, according to tf, are ignored. If the
/// pose of a body was not known, the map is processed again once it is: a latched map is sent only once.
///
/// Subscribes:
///   the parameter octomap/topic  octomap_msgs/Octomap  binary or full, of OcTree or ColorOcTree
///
/// Runs in a thread of its own.
class LiveMap {
 public:
  /// @param stop  ends the current work when it is set.
  LiveMap(const ros::NodeHandle& node, const MonitorParameters& parameters, SceneEditor& editor,
          const TfHistory& history, const std::atomic<bool>& stop);
  ~LiveMap();

 private:
  void work(const char* what, const std::function<void()>& job) const;
  void watchAge();
  void takeAgain();
  void take(const octomap_msgs::Octomap& message);
  std::string frameOf(const octomap_msgs::Octomap& message) const;

  /// Poses of the map, the robot and the objects attached to it.
  struct RobotPoses {
    std::vector<std::size_t> bodies;   // indices in the world
    std::vector<Isometry3d> X_W;       // of the map, then of these bodies
    std::vector<std::string> missing;  // why a pose is not known; empty if it is

    std::size_t unknown() const;
  };
  RobotPoses robotAt(const CheckedWorld& world, const octomap_msgs::Octomap& message,
                     const ros::WallDuration& patience) const;
  static std::vector<VoxelMask> masksOf(const CheckedWorld& world, const RobotPoses& poses);

  LiveMapParameters parameters_;
  SceneEditor& editor_;
  const TfHistory& history_;
  const std::atomic<bool>& stop_;
  VoxelMapOptions options_;
  std::unique_ptr<VoxelMap> map_;
  std::string frame_;
  double resolution_ = 0.0;                       // [m]
  std::map<std::string, BodyDescription> tiles_;  // by name
  enum class InScene {
    kAwaited,  // no map; the robot is NOT_CHECKED against it
    kTiles,    // the tiles in tiles_
    kOther,    // an older map, as setting the present tiles failed
  };
  InScene in_scene_ = InScene::kAwaited;
  ros::Time taken_;                       // when the last map was received
  octomap_msgs::Octomap::ConstPtr last_;  // the last map, if some poses were unknown
  std::size_t unknown_ = 0;               // number of those poses
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
  ros::WallTimer age_timer_, again_timer_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
};

}  // namespace sdf_ccd
