#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include "ros/messages/octomap_message.h"
#include "ros/monitor/scene_editor.h"
#include "sdf_ccd/monitor/voxel_map.h"

namespace sdf_ccd {

/// A map of voxels that comes on a topic, as tiles of the world: each map takes the place of the last one, what has not
/// changed of it is shared. While one is being taken the newest that comes waits, and others are dropped.
///
/// Before the first map, and where the last one is older than may be, the robot is NOT_CHECKED against the map.
///
/// Voxels that the robot, and what is attached to it, fill where tf had them at the map's stamp do not count. Where
/// that was not known of some body yet, the map is taken again when it is: a latched one comes only once.
///
/// Subscribes:
///   the parameter octomap/topic  octomap_msgs/Octomap  binary or full, of OcTree or ColorOcTree
///
/// Works in a thread of its own.
class LiveMap {
 public:
  /// @param stop  ends what is being done when it is set.
  LiveMap(const ros::NodeHandle& node, const MonitorParameters& parameters, SceneEditor& editor,
          const TfHistory& history, const std::atomic<bool>& stop);
  ~LiveMap();

 private:
  void work(const char* what, const std::function<void()>& job) const;
  void watchAge();
  void takeAgain();
  void take(const octomap_msgs::Octomap& message);
  std::string frameOf(const octomap_msgs::Octomap& message) const;

  /// Where the robot is, and what is attached to it.
  struct RobotPoses {
    std::vector<std::size_t> bodies;   // of the world
    std::vector<Isometry3d> X_W;       // of the map, and behind it of these bodies
    std::vector<std::string> missing;  // why they are not known; empty if they are

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
    kAwaited,  // no map, and it says so
    kTiles,    // what tiles_ has
    kOther,    // an older map, as tiles_ could not be taken over
  };
  InScene in_scene_ = InScene::kAwaited;
  ros::Time taken_;                       // when the last map came
  octomap_msgs::Octomap::ConstPtr last_;  // map that was taken, if some bodies were unknown then
  std::size_t unknown_ = 0;               // how many
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
  ros::WallTimer age_timer_, again_timer_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
};

}  // namespace sdf_ccd
