// Publishes the transforms of a robot (kind `robot`), or those of a hostile or broken node (all other kinds).

#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <limits>
#include <string>

#include <ros/ros.h>

#include "sdf_ccd/robot.h"

namespace sdf_ccd {
namespace {

geometry_msgs::TransformStamped stamped(const std::string& parent, const std::string& child, const ros::Time& stamp) {
  geometry_msgs::TransformStamped result;
  result.header.frame_id = parent;
  result.header.stamp = stamp;
  result.child_frame_id = child;
  result.transform.rotation.w = 1.0;
  return result;
}

/// Transforms of all links of a robot whose joints swing, as one message.
class Robot {
 public:
  explicit Robot(const std::string& urdf) : model_(urdf) {}

  const RobotModel& model() const { return model_; }

  tf2_msgs::TFMessage at(const ros::Time& time) const {
    JointPositions positions;
    for (const auto& [name, joint] : model_.urdf().joints_) {
      const bool turns = joint->type == urdf::Joint::REVOLUTE || joint->type == urdf::Joint::CONTINUOUS;
      if (turns && !joint->mimic) positions[name] = middle(*joint) + 0.2 * std::sin(std::fmod(time.toSec(), 1e4));
    }
    const std::vector<Isometry3d> X_RL = model_.forwardKinematics(positions);
    tf2_msgs::TFMessage message;
    for (std::size_t link = 1; link < X_RL.size(); ++link) {
      const int parent = model_.parent(static_cast<int>(link));
      const Isometry3d X_PL = X_RL[parent].inverse() * X_RL[link];
      auto sent = stamped(model_.links()[parent], model_.links()[link], time);
      const Quaterniond rotation(X_PL.linear());
      sent.transform.translation.x = X_PL.translation().x();
      sent.transform.translation.y = X_PL.translation().y();
      sent.transform.translation.z = X_PL.translation().z();
      sent.transform.rotation.w = rotation.w();
      sent.transform.rotation.x = rotation.x();
      sent.transform.rotation.y = rotation.y();
      sent.transform.rotation.z = rotation.z();
      message.transforms.push_back(sent);
    }
    return message;
  }

 private:
  static double middle(const urdf::Joint& joint) {
    return joint.limits ? 0.5 * (joint.limits->lower + joint.limits->upper) : 0.0;
  }

  RobotModel model_;
};

/// The messages of one kind of node. `count` is the number of a message.
class Storm {
 public:
  Storm(const std::string& kind, const Robot& robot, long frames) : kind_(kind), robot_(robot), frames_(frames) {}

  /// Whether a message goes to /tf_static instead of /tf.
  bool isStatic(long count) const { return kind_ == "kind" && count % 2 == 1; }

  tf2_msgs::TFMessage message(long count, const ros::Time& now) {
    tf2_msgs::TFMessage message;
    auto& sent = message.transforms;
    const std::vector<std::string>& links = robot_.model().links();
    const std::string &root = links.front(), &link = links[1 + count / 2 % (links.size() - 1)];
    if (kind_ == "robot") return robot_.at(now);
    if (kind_ == "links") {  // each link in a message of its own, with its own stamp
      const tf2_msgs::TFMessage all = robot_.at(now);
      sent = {all.transforms[static_cast<std::size_t>(count) % all.transforms.size()]};
      return message;
    }
    if (kind_ == "frames") {
      sent = {stamped(root, "foreign" + std::to_string(count % frames_), now)};
    } else if (kind_ == "chain") {
      const long frame = count % frames_;
      sent = {stamped(frame == 0 ? root : "chain" + std::to_string(frame - 1), "chain" + std::to_string(frame), now)};
    } else if (kind_ == "above") {  // ever more frames above the robot's root
      const long frame = count % frames_;
      sent = {stamped("above" + std::to_string(frame), frame == 0 ? root : "above" + std::to_string(frame - 1), now)};
    } else if (kind_ == "loop") {
      sent = {stamped(links.back(), link, now)};
    } else if (kind_ == "parents") {  // two publishers that disagree about the parent
      sent = {stamped(count % 2 ? root : "elsewhere" + std::to_string(count % frames_), link, now)};
    } else if (kind_ == "poses") {  // two publishers that disagree about the pose
      sent = robot_.at(now).transforms;
      for (auto& transform : sent) transform.transform.translation.x += count % 2;
    } else if (kind_ == "times") {  // two publishers whose clocks differ
      sent = robot_.at(now - ros::Duration(count % 2 ? 5.0 : 0.0)).transforms;
    } else if (kind_ == "kind") {  // a frame on both /tf and /tf_static
      sent = {stamped(root, link, now)};
      sent[0].transform.translation.x = 1e-3 * static_cast<double>(count % 1000);
    } else if (kind_ == "values") {
      sent = {hostileValue(count, root, link, now)};
    } else {
      throw std::invalid_argument("no storm " + kind_);
    }
    return message;
  }

 private:
  static geometry_msgs::TransformStamped hostileValue(long count, const std::string& root, const std::string& link,
                                                      const ros::Time& now) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN(), kMax = std::numeric_limits<double>::max();
    constexpr std::uint32_t kLast = std::numeric_limits<std::uint32_t>::max();
    auto sent = stamped(root, link, now);
    switch (count % 16) {
      case 0:
        sent.header.stamp.sec = kLast;
        sent.header.stamp.nsec = 999999999;
        break;
      case 1:
        sent.header.stamp.sec = kLast;
        sent.header.stamp.nsec = kLast;
        break;
      case 2:
        sent.header.stamp.sec = (1u << 31) - 1;
        sent.header.stamp.nsec = kLast;
        break;
      case 3:
        sent.header.stamp.nsec = kLast;
        break;
      case 4:
        sent.header.stamp = ros::Time();
        break;
      case 5:
        sent.header.stamp.sec = 0;
        sent.header.stamp.nsec = 1;
        break;
      case 6:
        sent.transform.translation.x = kNone;
        break;
      case 7:
        sent.transform.translation.y = kMax;
        break;
      case 8:
        sent.transform.rotation.w = kNone;
        break;
      case 9:
        sent.transform.rotation.w = 5e-324;
        break;
      case 10:
        sent.transform.rotation.w = kMax;
        break;
      case 11:
        sent.header.frame_id = link;
        break;
      case 12:
        sent.child_frame_id.clear();
        break;
      case 13:
        sent.header.frame_id = "////";
        break;
      case 14:
        sent.child_frame_id.assign(1000000, 'x');
        break;
      default:
        sent.header.frame_id.assign(1000000, 'y');
        break;
    }
    return sent;
  }

  std::string kind_;
  const Robot& robot_;
  long frames_;
};

int run(const ros::NodeHandle& private_node) {
  std::string urdf;
  ros::NodeHandle node;
  if (!node.getParam("robot_description", urdf)) throw std::runtime_error("no robot_description");
  const Robot robot(urdf);
  Storm storm(private_node.param<std::string>("kind", "robot"), robot, private_node.param("frames", 100000));
  const double rate = private_node.param("rate", 30.0);
  const ros::Publisher moving = node.advertise<tf2_msgs::TFMessage>("/tf", 1000);
  const ros::Publisher fixed = node.advertise<tf2_msgs::TFMessage>("/tf_static", 1000);
  const ros::WallTime start = ros::WallTime::now();
  const double seconds = private_node.param("seconds", 1e9);
  for (long count = 0; ros::ok(); ++count) {
    const double due = static_cast<double>(count) / rate;
    if (due > seconds) break;
    ros::WallTime::sleepUntil(start + ros::WallDuration(due));
    (storm.isStatic(count) ? fixed : moving).publish(storm.message(count, ros::Time::now()));
  }
  return 0;
}

}  // namespace
}  // namespace sdf_ccd

int main(int argc, char** argv) {
  ros::init(argc, argv, "transform_storm", ros::init_options::AnonymousName);
  return sdf_ccd::run(ros::NodeHandle("~"));
}
