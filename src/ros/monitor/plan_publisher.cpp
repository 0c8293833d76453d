#include "ros/monitor/plan_publisher.h"

#include "ros/monitor/plan_message.h"

namespace sdf_ccd {
namespace {

constexpr double kPeriod = 1.0;  // between plans whose rate is limited [s]

}  // namespace

PlanPublisher::PlanPublisher(ros::NodeHandle private_node)
    : publisher_(private_node.advertise<Plan>("plan", 1, true)) {}

void PlanPublisher::limitRate(const ros::NodeHandle& node, std::function<std::shared_ptr<const CheckedWorld>()> world,
                              const std::string& fixed_frame) {
  timer_ = node.createWallTimer(
      ros::WallDuration(kPeriod),
      [this, world = std::move(world), fixed_frame](const ros::WallTimerEvent&) { send(*world(), fixed_frame); });
}

void PlanPublisher::publish(const CheckedWorld& world, const std::string& fixed_frame) {
  if (!timer_.isValid()) send(world, fixed_frame);
}

void PlanPublisher::send(const CheckedWorld& world, const std::string& fixed_frame) {
  if (world.version() == version_) return;
  version_ = world.version();
  publisher_.publish(boost::make_shared<Plan>(toPlan(world, fixed_frame, ros::Time::now())));
}

}  // namespace sdf_ccd
