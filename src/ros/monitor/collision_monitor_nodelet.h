#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>
#include <ros/spinner.h>
#include <std_srvs/Empty.h>

#include "ros/monitor/diagnostics.h"
#include "ros/monitor/live_map.h"
#include "ros/monitor/outputs.h"
#include "ros/monitor/queries.h"
#include "ros/monitor/reconfiguration.h"
#include "ros/monitor/scene_editor.h"
#include "ros/tf/joint_watch.h"
#include "sdf_ccd/GetPlan.h"
#include "sdf_ccd/MonitorState.h"
#include "sdf_ccd/UpdateScene.h"

namespace sdf_ccd {

/// Watches a robot that tf2 moves, and says for every cycle what touched when, where and how hard.
///
/// Parameters: see config/monitor.yaml; robot_description and robot_description_semantic are looked for upwards. The
/// first is waited for.
///
/// Subscribes:
///   /tf, /tf_static  tf2_msgs/TFMessage
///   the parameter octomap/topic  octomap_msgs/Octomap  see LiveMap
///   joint_states     sensor_msgs/JointState  only to name joints whose positions are not finite
///
/// Publishes, below the node's name, besides what Outputs and Diagnostics do:
///   state  sdf_ccd/MonitorState  every cycle, and, as NOT_CHECKED, once a second while there is none and on unloading;
///                                latched
///   plan   sdf_ccd/Plan          what is checked against what, and what is left out and why; latched
///   planned  visualization_msgs/MarkerArray  the last motion that query_motion was asked about
///
/// Serves, below the node's name:
///   query_motion  sdf_ccd/QueryMotion
///   query_motions  sdf_ccd/QueryMotions
///   query_points  sdf_ccd/QueryPoints
///   update_scene  sdf_ccd/UpdateScene  changes the world's objects and the pairs, while the monitor runs
///   get_plan      sdf_ccd/GetPlan      what is checked now
///   reset         std_srvs/Empty       forgets all contacts; the next cycle begins with the next transforms
///   what Reconfiguration does
///
/// Building and cycles have a thread of their own, and so has what publishes and draws them; transforms have a callback
/// queue and a thread, services a queue and a thread per query that is answered at a time. Unloading ends all of them
/// within 0.2 s, whatever they do.
class CollisionMonitor : public nodelet::Nodelet {
 public:
  ~CollisionMonitor() override;

 private:
  void onInit() override;
  void serve();

  void run();
  void setUpThenCycle();
  void readWhenThere();
  void setUp();
  void buildFields();
  void logNowAndThen(const std::string& progress);
  void listen();
  ros::Subscriber listenTo(const std::string& tf_topic, bool is_static);
  void hearStaticAgain();
  void take(const tf2_msgs::TFMessage& message, bool is_static);
  void sayWhatIsDropped();
  void betweenCycles();
  void cycle();
  bool isSilent() const;
  void publishWorld();
  void idle(const std::string& reason);
  void publishUnchecked(const std::string& reason);
  void forget(const std::string& reason);
  void publishCycle();
  void warnWhileUnchecked(bool is_unchecked);
  void warnOfMovingFrame();
  std::string contradicted();

  bool queryMotion(QueryMotion::Request& request, QueryMotion::Response& response);
  bool queryMotions(QueryMotions::Request& request, QueryMotions::Response& response);
  bool queryPoints(QueryPoints::Request& request, QueryPoints::Response& response);
  bool updateScene(UpdateScene::Request& request, UpdateScene::Response& response);
  bool getPlan(GetPlan::Request& request, GetPlan::Response& response);
  bool reset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool isReady(std::string& why_not);
  template <class Request, class Response>
  void answer(const Request& request, Response& response);
  void publishPlan(const CheckedWorld& world);

  // Set while setting up, in this order; then only the cycles' thread changes them.
  MonitorParameters parameters_;
  bool is_world_drawn_ = false;
  DescribedScene described_;
  std::unique_ptr<WorldEditor> world_editor_;
  std::shared_ptr<const CheckedWorld> first_world_;
  std::unique_ptr<MonitorLoop> loop_;
  std::unique_ptr<ProximityOutputs> proximity_;
  std::unique_ptr<Outputs> outputs_;
  std::unique_ptr<Queries> queries_;
  std::unique_ptr<SceneEditor> scene_editor_;
  std::unique_ptr<LiveMap> live_map_;
  std::unique_ptr<JointWatch> joint_watch_;
  std::unique_ptr<Reconfiguration> reconfiguration_;

  std::unique_ptr<Diagnostics> diagnostics_;
  MonitorHealth health_;
  ros::WallTime last_cycle_;   // when it was published
  ros::WallTime last_step_;    // of the loop that found anything
  ros::WallTime last_idle_;    // when it was said that nothing is checked; 0 after a cycle
  ros::WallTime last_late_;    // when transforms contradicted a cycle
  std::string late_;           // what was said of that
  ros::WallTime last_log_;     // of the progress of building
  ros::WallTime last_static_;  // when /tf_static was listened to
  ros::WallTime last_frame_check_;
  ros::WallTime unchecked_since_, last_warning_;  // 0: all is checked; none was given

  std::mutex plan_mutex_;
  ros::WallTime plan_published_;
  ros::WallTimer plan_timer_;  // for the last one of a live map

  MessagePool<MonitorState> state_messages_;
  ros::Publisher state_publisher_;
  ros::Publisher plan_publisher_;
  ros::Publisher world_publisher_;
  ros::CallbackQueue service_queue_;
  ros::CallbackQueue tf_queue_;
  std::vector<ros::ServiceServer> services_;
  ros::Subscriber tf_subscriber_, tf_static_subscriber_, joint_subscriber_;
  std::unique_ptr<ros::AsyncSpinner> service_spinner_, tf_spinner_;

  std::mutex ready_mutex_;
  bool ready_ = false;  // guarded by ready_mutex_, as the reason
  std::string not_ready_ = "starting";
  std::atomic<bool> reset_asked_{false};
  std::atomic<bool> stop_{false};
  CycleTrigger trigger_;
  std::thread thread_;
};

}  // namespace sdf_ccd
