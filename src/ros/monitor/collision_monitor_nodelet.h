#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include <nodelet/nodelet.h>

#include "ros/monitor/contact_log.h"
#include "ros/monitor/cycle_watchdog.h"
#include "ros/monitor/force_builder.h"
#include "ros/monitor/health_watch.h"
#include "ros/monitor/live_map.h"
#include "ros/monitor/monitor_services.h"
#include "ros/monitor/outputs.h"
#include "ros/monitor/plan_publisher.h"
#include "ros/monitor/reconfiguration.h"
#include "ros/monitor/transform_listener.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd {

/// Monitors a robot that tf2 moves, and reports for every cycle what touched when, where and how hard.
///
/// Parameters: see config/monitor.yaml; robot_description and robot_description_semantic are searched for upwards. The
/// nodelet waits for the first.
///
/// Subscriptions are those of TransformListener and LiveMap, services those of MonitorServices and Reconfiguration.
///
/// Publishes, below the node's name, besides the topics of Outputs, PlanPublisher and Diagnostics:
///   state    sdf_ccd/MonitorState            every cycle; as NOT_CHECKED once a second while none runs,
///                                            while one takes longer than max_latency, and on unloading; latched
///   planned  visualization_msgs/MarkerArray  the motion that query_motion has checked last
///
/// Separate threads build and run cycles, publish and draw their results, receive transforms, and answer services.
/// Unloading ends all of them within 0.2 s, whatever they do.
class CollisionMonitor : public nodelet::Nodelet {
 public:
  ~CollisionMonitor() override;

 private:
  void onInit() override;

  void run();
  void setUpThenCycle();
  void waitForParameters();
  void setUp();
  void buildScene();
  void followWithForces();
  void logProgress(const std::string& progress);
  std::string attempt(const std::function<void()>& work) const;
  void betweenCycles();
  void warnAboutMapDistances();
  void cycle();
  bool isSilent() const;
  void reportLongCycle(CycleWatchdog::Seconds elapsed) const;
  void publishCycle();
  void logContacts();
  void publishPlan(const CheckedWorld& world) { plan_->publish(world, described_.fixed_frame); }
  void publishWorld();
  void reportIdle(const std::string& reason);
  void publishUnchecked(const std::string& reason);
  boost::shared_ptr<MonitorState> uncheckedState(const std::string& reason) const;
  void restart(const std::string& reason);

  // Set during set-up, in this order; afterwards only the thread of the cycles changes them.
  MonitorParameters parameters_;
  DescribedScene described_;
  std::unique_ptr<WorldEditor> world_editor_;
  std::shared_ptr<const CheckedWorld> first_world_;
  std::unique_ptr<MonitorLoop> loop_;
  std::unique_ptr<ProximityOutputs> proximity_;
  std::unique_ptr<Outputs> outputs_;
  std::unique_ptr<CycleWatchdog> watchdog_;
  std::unique_ptr<TransformListener> listener_;
  std::unique_ptr<Queries> queries_;
  std::unique_ptr<SceneEditor> scene_editor_;
  std::unique_ptr<LiveMap> live_map_;
  std::unique_ptr<ForceBuilder> force_builder_;
  std::unique_ptr<Reconfiguration> reconfiguration_;

  std::unique_ptr<Diagnostics> diagnostics_;
  HealthWatch health_watch_;
  ContactLog contact_log_;
  ros::WallTime last_step_;  // time of the last cycle or restart
  ros::WallTime last_idle_;  // when "nothing is checked" was last published; 0 after a cycle
  ros::WallTime last_log_;   // of the progress of building
  bool is_world_drawn_ = false;

  MessagePool<MonitorState> state_messages_;
  ros::Publisher state_publisher_, world_publisher_;
  std::atomic<bool> stop_{false};
  std::unique_ptr<MonitorServices> services_;
  std::unique_ptr<PlanPublisher> plan_;  // its timer uses the services' queue
  CycleTrigger trigger_;
  std::thread thread_;
};

}  // namespace sdf_ccd
