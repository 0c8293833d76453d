#include "ros/monitor/transform_listener.h"

#include <ros/console.h>

namespace sdf_ccd {
namespace {

constexpr double kStaticPeriod = 2.0;  // minimum time between two subscriptions to /tf_static [s]
constexpr int kQueue = 1000;           // messages that may wait

}  // namespace

TransformListener::TransformListener(const ros::NodeHandle& node, const RobotModel& robot, TfHistory& history,
                                     CycleTrigger& trigger)
    : node_(node), history_(history), trigger_(trigger), joint_watch_(robot) {
  node_.setCallbackQueue(&queue_);
  tf_ = subscribe("/tf", false);
  tf_static_ = subscribe("/tf_static", true);
  const boost::function<void(const sensor_msgs::JointStateConstPtr&)> watch =
      [this](const sensor_msgs::JointStateConstPtr& joints) {
        joint_watch_.add(*joints);
        trigger_.onJointStates();
      };
  joint_states_ = node_.subscribe<sensor_msgs::JointState>("joint_states", 10, watch);
  spinner_ = std::make_unique<ros::AsyncSpinner>(1, &queue_);
  spinner_->start();
}

TransformListener::~TransformListener() {
  queue_.disable();  // the spinner wakes up at once
  spinner_->stop();
}

ros::Subscriber TransformListener::subscribe(const std::string& tf_topic, bool is_static) {
  const boost::function<void(const tf2_msgs::TFMessageConstPtr&)> add =
      [this, is_static](const tf2_msgs::TFMessageConstPtr& message) { receive(*message, is_static); };
  return node_.subscribe<tf2_msgs::TFMessage>(tf_topic, kQueue, add, ros::VoidConstPtr(),
                                              ros::TransportHints().tcpNoDelay());
}

void TransformListener::recoverStatic() {
  const ros::WallTime now = ros::WallTime::now();
  if ((now - last_static_).toSec() < kStaticPeriod || !history_.takeMissedStatic()) return;
  last_static_ = now;
  tf_static_ = subscribe("/tf_static", true);
}

/// An exception that escaped would end the nodelet manager with all its nodelets.
void TransformListener::receive(const tf2_msgs::TFMessage& message, bool is_static) {
  try {
    history_.watchClock(ros::Time::now());
    history_.add(message, is_static);
    if (!is_static) trigger_.onTransforms();
    for (std::size_t i = 0; i < message.transforms.size() && trigger_.wantsFrames(); ++i) {
      trigger_.onFrame(withoutLeadingSlash(message.transforms[i].child_frame_id));
    }
  } catch (const std::exception& error) {
    ROS_WARN_THROTTLE(10.0, "A message on /tf or /tf_static is dropped: %s", error.what());
  }
}

void TransformListener::report(MonitorHealth& health) {
  const TfIgnored ignored = history_.ignored();
  if (ignored.refused > health.ignored.refused) {
    ROS_WARN_THROTTLE(10.0, "%ld invalid transforms were ignored so far; the last one: %s", ignored.refused,
                      ignored.refusal.c_str());
  }
  if (ignored.not_kept > health.ignored.not_kept) {
    ROS_WARN_THROTTLE(
        10.0, "tf has more frames than the monitor stores: %ld transforms of frames that no body needs were dropped",
        ignored.not_kept);
  }
  health.ignored = ignored;
  health.bad_joints = joint_watch_.lines("joint_states");
}

}  // namespace sdf_ccd
