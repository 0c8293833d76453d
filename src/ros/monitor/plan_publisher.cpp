#include "ros/monitor/plan_publisher.h"

#include "ros/monitor/plan_message.h"

namespace sdf_ccd {
namespace {

constexpr double kPeriod = 1.0;  // minimum time between plans whose rate is limited [s]

}  // namespace

PlanPublisher::PlanPublisher(ros::NodeHandle private_node)
    : publisher_(private_node.advertise<Plan>("plan", 1, true)) {}

void PlanPublisher::limitRate(const ros::NodeHandle& node, const std::function<void()>& again) {
  const std::lock_guard<std::mutex> lock(mutex_);
  timer_ = node.createWallTimer(
      ros::WallDuration(kPeriod), [again](const ros::WallTimerEvent&) { again(); }, true, false);
}

void PlanPublisher::publish(const CheckedWorld& world, const std::string& fixed_frame) {
  const ros::WallTime now = ros::WallTime::now();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::WallDuration wait = published_ + ros::WallDuration(kPeriod) - now;
    if (timer_.isValid() && !published_.isZero() && wait.toSec() > 0.0) {  // another one may come before that
      timer_.stop();
      timer_.setPeriod(wait);
      timer_.start();
      return;
    }
    published_ = now;
  }
  publisher_.publish(boost::make_shared<Plan>(toPlan(world, fixed_frame, ros::Time::now())));
}

}  // namespace sdf_ccd
