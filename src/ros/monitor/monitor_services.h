#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/Empty.h>

#include "ros/monitor/queries.h"
#include "ros/monitor/scene_editor.h"
#include "sdf_ccd/GetPlan.h"
#include "sdf_ccd/UpdateScene.h"

namespace sdf_ccd {

/// Serves, below the node's name, with one thread per request:
///   query_motion   sdf_ccd/QueryMotion
///   query_motions  sdf_ccd/QueryMotions
///   query_points   sdf_ccd/QueryPoints
///   update_scene   sdf_ccd/UpdateScene  changes the world's objects and the pairs, while the monitor runs
///   get_plan       sdf_ccd/GetPlan      what is checked now
///   reset          std_srvs/Empty       forgets all contacts; the next cycle begins with the next transforms. Fails
///                                       more than once a second, and where the parameter requests/allow does not hold
///                                       it
/// Until the monitor is ready, the responses say what it waits for.
class MonitorServices {
 public:
  /// @param stop  ends the current answers when it is set.
  MonitorServices(const ros::NodeHandle& private_node, const std::atomic<bool>& stop);

  /// Ends all answers; takes as long as they need to notice that.
  ~MonitorServices();

  /// For other callbacks that these threads are to call: use a copy.
  const ros::NodeHandle& node() const { return node_; }

  void setWaiting(const std::string& reason);

  /// Answers requests from now on. @param queries, editor  must live until stop().
  void setReady(Queries& queries, SceneEditor& editor, const std::string& fixed_frame, bool may_reset);

  /// Whether a reset has been requested since the last call.
  bool consumeReset() { return reset_requested_.exchange(false); }

  /// Answers no more requests.
  void stop();

 private:
  template <class Request, class Response>
  bool query(Request& request, Response& response);
  bool updateScene(UpdateScene::Request& request, UpdateScene::Response& response);
  bool getPlan(GetPlan::Request& request, GetPlan::Response& response);
  bool reset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool isReady(std::string& why_not);
  std::string whyNoReset();
  template <class Response, class Answer>
  bool serve(Response& response, const Answer& answer);

  const std::atomic<bool>& stop_;
  std::atomic<bool> reset_requested_{false};
  std::mutex mutex_;
  std::string waiting_ = "starting";  // guarded by mutex_, as all up to last_reset_
  Queries* queries_ = nullptr;        // null: not ready
  SceneEditor* editor_ = nullptr;
  std::string fixed_frame_;
  bool may_reset_ = true;
  ros::SteadyTime last_reset_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_;
};

}  // namespace sdf_ccd
