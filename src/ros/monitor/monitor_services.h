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

/// Serves, below the node's name, with a thread per query that is answered at a time:
///   query_motion   sdf_ccd/QueryMotion
///   query_motions  sdf_ccd/QueryMotions
///   query_points   sdf_ccd/QueryPoints
///   update_scene   sdf_ccd/UpdateScene  changes the world's objects and the pairs, while the monitor runs
///   get_plan       sdf_ccd/GetPlan      what is checked now
///   reset          std_srvs/Empty       forgets all contacts; the next cycle begins with the next transforms
/// Until there is something to answer with, the answers say what is being waited for.
class MonitorServices {
 public:
  /// @param stop  ends what is being answered when it is set.
  MonitorServices(const ros::NodeHandle& private_node, const std::atomic<bool>& stop);

  /// Ends all answers, which takes no longer than these take to see that they are to stop.
  ~MonitorServices();

  /// What else is to be called by these threads takes a copy of this.
  const ros::NodeHandle& node() const { return node_; }

  void setWaiting(const std::string& reason);

  /// From now on requests are answered. @param queries, editor  live until stop().
  void setReady(Queries& queries, SceneEditor& editor, const std::string& fixed_frame);

  /// Whether a reset has been asked for since the last call.
  bool takeReset() { return reset_asked_.exchange(false); }

  /// No request is answered any more.
  void stop();

 private:
  bool queryMotion(QueryMotion::Request& request, QueryMotion::Response& response);
  bool queryMotions(QueryMotions::Request& request, QueryMotions::Response& response);
  bool queryPoints(QueryPoints::Request& request, QueryPoints::Response& response);
  bool updateScene(UpdateScene::Request& request, UpdateScene::Response& response);
  bool getPlan(GetPlan::Request& request, GetPlan::Response& response);
  bool reset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool isReady(std::string& why_not);
  template <class Request, class Response>
  void answer(const Request& request, Response& response);

  const std::atomic<bool>& stop_;
  std::atomic<bool> reset_asked_{false};
  std::mutex mutex_;
  std::string waiting_ = "starting";  // guarded by mutex_, as all up to the frame
  Queries* queries_ = nullptr;        // null: not ready
  SceneEditor* editor_ = nullptr;
  std::string fixed_frame_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_;
};

}  // namespace sdf_ccd
