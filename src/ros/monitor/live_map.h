#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include "monitor/map/voxel_map.h"
#include "ros/messages/octomap_message.h"
#include "ros/monitor/map_frame_watch.h"
#include "ros/monitor/objects_in_map.h"
#include "ros/monitor/scene_editor.h"
#include "ros/monitor/standing_warnings.h"

namespace sdf_ccd {

/// A voxel map that is received on a topic, as tiles of the world. Each map replaces the last one; unchanged tiles are
/// shared. While one map is processed the newest one waits, and others are dropped.
///
/// Before the first map, and while the last one is too old, the robot is NOT_CHECKED against the map. Whoever uses the
/// map tests its age as well (MapAge): this class may be busy with a map meanwhile.
///
/// Voxels that the robot and the objects attached to it occupy at the map's stamp, according to tf, are ignored. If tf
/// lags behind the stamp, the map waits for it, up to max_latency; the last map stays until then. A body whose pose at
/// the stamp is still not known has none of its voxels ignored: they count as obstacles, which is logged. Its present
/// pose is no substitute, as real obstacles near it would be lost; it only tells where unknown space counts. Once tf
/// knows more, the map is processed again.
///
/// Nor is anything ignored that was occupied before the robot came near it (VoxelMemory): until a map shows it as free,
/// it is an obstacle. Voxels in objects of the scene are judged as these (VoxelObjects), from the moment on that they
/// are added; what an object leaves is the map's again.
///
/// Of a map that is older than the transforms (a latched one, made before the monitor started) this leaves all voxels:
/// right for a map that was made without the robot. So it is for a map without a stamp.
///
/// Subscribes:
///   the parameter octomap/topic  octomap_msgs/Octomap  binary or full, of OcTree or ColorOcTree
///
/// Runs in threads of its own, which wait for no request (SceneEditor::setMap()).
class LiveMap {
 public:
  /// What the map is, besides its topic.
  struct Place {
    std::string root_frame;      ///< of the robot
    StandingWarnings& warnings;  ///< receives one while unproven() is not 0
  };

  /// @param stop  ends the current work when it is set.
  LiveMap(const ros::NodeHandle& node, const MonitorParameters& parameters, SceneEditor& editor,
          const TfHistory& history, const Place& place, const std::atomic<bool>& stop);
  ~LiveMap();

  /// Number of voxels that are ignored as the robot's own though they may be obstacles: VoxelMemory::Seen::unproven.
  std::size_t unproven() const { return unproven_; }

  /// The next map is taken for the first one. May be called from any thread.
  void forget() { forgets_ = true; }

 private:
  void run(const char* what, const std::function<void()>& job) const;
  void checkAge();
  void updateMasks();
  void judgeObjects();
  void forgetIfMoved(const std::string& frame, const RobotInMap& robot, const ros::Time& stamp);
  bool apply(VoxelMap::Change& change, const std::shared_ptr<MapAge>& age);
  void process(const octomap_msgs::Octomap& message, const ros::Time& received, RobotInMap& robot, bool is_again);
  void begin(const std::string& frame, double resolution, const VoxelMapOptions& options);
  void markOutdated();
  std::vector<VoxelMask> masksOf(const CheckedWorld& world, RobotInMap& robot) const;
  void waitForTf(const CheckedWorld& world, RobotInMap& robot) const;
  std::string frameOf(const octomap_msgs::Octomap& message) const;

  LiveMapParameters parameters_;
  double max_latency_;  // longest wait for tf [s]
  double max_gap_;      // between transforms [s]
  SceneEditor& editor_;
  WorkArena arena_;
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
  std::shared_ptr<MapAge> age_;                 // of the tiles; null before the first map, or if it does not count
  octomap_msgs::Octomap::ConstPtr incomplete_;  // the last map, if some poses at its stamp were not known
  ros::Time incomplete_received_;
  ros::Time received_;  // when the last map was processed
  std::unique_ptr<RobotInMap> robot_;           // in the last map
  std::size_t unknown_ = 0;                     // RobotInMap::unknown() of the present masks
  MapFrameWatch frame_watch_;
  StandingWarnings& warnings_;
  std::uint64_t judged_version_ = 0;  // of the world whose objects were judged last
  std::atomic<std::size_t> unproven_{0};
  std::atomic<bool> forgets_{false};
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
  ros::WallTimer age_timer_, masks_timer_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
};

}  // namespace sdf_ccd
