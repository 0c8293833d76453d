#include "ros/monitor/monitor_services.h"

#include "ros/monitor/plan_message.h"
#include "sdf_ccd/cancel.h"

namespace sdf_ccd {
namespace {

constexpr double kResetPeriod = 1.0;  // [s]

/// One for each query and change that is answered or waits, and one to refuse more.
int threads() {
  return QueryLimits().queries + 4;
}

}  // namespace

MonitorServices::MonitorServices(const ros::NodeHandle& private_node, const std::atomic<bool>& stop)
    : stop_(stop), node_(private_node), spinner_(threads(), &queue_) {
  node_.setCallbackQueue(&queue_);
  services_ = {node_.advertiseService("query_motion",
                                      &MonitorServices::query<QueryMotion::Request, QueryMotion::Response>, this),
               node_.advertiseService("query_motions",
                                      &MonitorServices::query<QueryMotions::Request, QueryMotions::Response>, this),
               node_.advertiseService("query_points",
                                      &MonitorServices::query<QueryPoints::Request, QueryPoints::Response>, this),
               node_.advertiseService("update_scene", &MonitorServices::updateScene, this),
               node_.advertiseService("get_plan", &MonitorServices::getPlan, this),
               node_.advertiseService("reset", &MonitorServices::reset, this)};
  spinner_.start();
}

MonitorServices::~MonitorServices() {
  stop();
}

void MonitorServices::stop() {
  queue_.disable();  // the spinner wakes up at once
  spinner_.stop();
}

void MonitorServices::setWaiting(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (queries_ == nullptr) waiting_ = reason;
}

void MonitorServices::setReady(Queries& queries, SceneEditor& editor, const std::string& fixed_frame, bool may_reset) {
  const std::lock_guard<std::mutex> lock(mutex_);
  queries_ = &queries;
  editor_ = &editor;
  fixed_frame_ = fixed_frame;
  may_reset_ = may_reset;
}

bool MonitorServices::isReady(std::string& why_not) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (queries_ == nullptr) why_not = "not ready: " + waiting_;
  return queries_ != nullptr;
}

/// Answers once the monitor is ready, and until it ends.
template <class Response, class Answer>
bool MonitorServices::serve(Response& response, const Answer& answer) {
  const Response none = response;
  if (!isReady(response.message)) return true;
  const CancelScope scope(stop_);
  try {
    answer();
  } catch (const Cancelled&) {
    response = none;
    response.message = "the monitor is shutting down";
  }
  return true;
}

template <class Request, class Response>
bool MonitorServices::query(Request& request, Response& response) {
  return serve(response, [&] { queries_->answer(request, response); });
}

bool MonitorServices::updateScene(UpdateScene::Request& request, UpdateScene::Response& response) {
  response.failed_change = -1;
  return serve(response, [&] { editor_->update(request, response); });
}

bool MonitorServices::getPlan(GetPlan::Request&, GetPlan::Response& response) {
  return serve(response, [&] {
    response.plan = toPlan(*queries_->world(), fixed_frame_, ros::Time::now());
    response.success = true;
  });
}

/// Nothing is known of contacts until the next cycle after each reset.
std::string MonitorServices::whyNoReset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!may_reset_) return "the parameter requests/allow does not hold reset";
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (!last_reset_.isZero() && (now - last_reset_).toSec() < kResetPeriod)
    return "there was one less than a second ago";
  last_reset_ = now;
  reset_requested_ = true;
  return {};
}

bool MonitorServices::reset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
  const std::string why_not = whyNoReset();
  if (!why_not.empty()) ROS_WARN_THROTTLE(1.0, "reset is refused: %s", why_not.c_str());
  return why_not.empty();
}

}  // namespace sdf_ccd
