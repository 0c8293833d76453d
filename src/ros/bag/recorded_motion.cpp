#include "ros/bag/recorded_motion.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <rosbag/view.h>

#include "common/counted.h"
#include "common/number_text.h"
#include "robot/joint_kind.h"
#include "ros/bag/read_bag.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kNamed = 4;  // examples in an error

bool isStatic(const std::string& topic) {
  return withoutLeadingSlash(topic) == "tf_static";
}

}  // namespace

RecordedMotion::RecordedMotion(const std::string& file, const DescribedScene& described,
                               const RecordedMotionOptions& options)
    : file_(file), options_(options), joints_(described.robot, described.tf_prefix), joint_watch_(*described.robot) {
  for (const auto& [name, joint] : described.robot->urdf().joints_) {
    if (hasPosition(*joint) && !joint->mimic) unnamed_.insert(name);
  }
  readBag(file_, [&] {
    bag_.open(file_, rosbag::bagmode::Read);
    findTopics();
    findFrames(described);
  });
}

void RecordedMotion::findTopics() {
  rosbag::View all(bag_);
  if (all.size() == 0) throw std::runtime_error(file_ + ": contains no messages");
  const ros::Time first = all.getBeginTime(), last = all.getEndTime();
  const double length = secondsBetween(first, last);
  if (length > kLongestDuration) {
    throw std::runtime_error(file_ + ": lasts " + numberText(length) + " s, longer than ROS can tell times apart: " +
                             std::to_string(std::int64_t(kLongestDuration)) + " s");
  }
  if (options_.start > length) {
    throw std::runtime_error(file_ + ": lasts " + numberText(length) + " s, nothing is left after the start at " +
                             numberText(options_.start) + " s");
  }
  begin_ = first + ros::Duration(options_.start);
  end_ = options_.duration < (last - begin_).toSec() ? begin_ + ros::Duration(options_.duration) : last;

  const std::string tf_type = ros::message_traits::md5sum<tf2_msgs::TFMessage>();  // that of tf/tfMessage is the same
  std::set<std::string> tf, joint_states;
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    const std::string name = withoutLeadingSlash(connection->topic);
    if ((name == "tf" || name == "tf_static") && connection->md5sum == tf_type) tf.insert(connection->topic);
    if (connection->datatype == "sensor_msgs/JointState") joint_states.insert(connection->topic);
  }
  tf_topics_.assign(tf.begin(), tf.end());
  joint_state_topics_.assign(joint_states.begin(), joint_states.end());
  if (tf.empty() && joint_states.empty()) throw std::runtime_error(file_ + ": holds neither tf nor joint states");
}

void RecordedMotion::findFrames(const DescribedScene& described) {
  const std::vector<std::string> links = joints_.frames();
  std::set<std::string> wanted(links.begin(), links.end());
  if (described.fixed_frame != described.root_frame) wanted.insert(described.fixed_frame);
  rosbag::View view(bag_, rosbag::TopicQuery(tf_topics_), ros::TIME_MIN, end_);
  for (auto message = view.begin(); message != view.end() && !wanted.empty(); ++message) {
    const tf2_msgs::TFMessage::ConstPtr tf = message->instantiate<tf2_msgs::TFMessage>();
    if (!tf) continue;
    for (const geometry_msgs::TransformStamped& transform : tf->transforms) {
      const std::string child = withoutLeadingSlash(transform.child_frame_id);
      tf_frames_.insert(child);
      wanted.erase(child);
      if (withoutLeadingSlash(transform.header.frame_id) == described.fixed_frame) wanted.erase(described.fixed_frame);
    }
  }
  const auto isNamed = [&](const std::string& link) { return tf_frames_.count(link) > 0; };
  // A bag of /joint_states and /tf_static has the links on fixed joints in tf.
  const std::vector<std::string> telling = joint_state_topics_.empty() ? links : joints_.movableFrames();
  if (std::any_of(telling.begin(), telling.end(), isNamed) || (telling.empty() && !tf_topics_.empty())) {
    joint_state_topics_.clear();
  } else if (links.empty()) {
    throw std::runtime_error(file_ + ": holds no tf, and the robot has no other links whose joints could move");
  } else {
    requireJointStates("the links are " + firstOf(links, kNamed) +
                       (tf_topics_.empty() ? ", there is no tf" : ", the tf's frames " + firstOf(tf_frames_, kNamed)));
  }
  fixed_links_ = joints_.fixed(begin_, [&](const std::string& link) { return !isNamed(link); }).transforms.size();
  const bool is_link = std::find(links.begin(), links.end(), described.fixed_frame) != links.end();
  if (wanted.count(described.fixed_frame) > 0 && !is_link) {
    throw std::runtime_error(file_ + ": the fixed frame " + described.fixed_frame +
                             " is neither in tf nor a link of the robot");
  }
}

void RecordedMotion::requireJointStates(const std::string& why) {
  std::vector<std::string>& topics = joint_state_topics_;
  const auto chosen = std::find_if(topics.begin(), topics.end(), [&](const std::string& topic) {
    return options_.joint_states.empty() ? withoutLeadingSlash(topic) == "joint_states"
                                         : withoutLeadingSlash(topic) == withoutLeadingSlash(options_.joint_states);
  });
  if (chosen != topics.end()) {
    topics = {std::string(*chosen)};
  } else if (!options_.joint_states.empty()) {
    throw std::runtime_error(file_ + ": contains no joint states on " + options_.joint_states);
  } else if (topics.empty()) {
    throw std::runtime_error(file_ + ": its tf names no link of the robot, and it contains no joint states: " + why);
  } else if (topics.size() > 1) {
    throw std::runtime_error(file_ + ": holds joint states on " + firstOf(topics, kNamed) + ": choose one of them");
  }
  std::set<std::string> names;
  rosbag::View view(bag_, rosbag::TopicQuery(topics), ros::TIME_MIN, end_);
  for (const rosbag::MessageInstance& message : view) {
    const sensor_msgs::JointState::ConstPtr joints = message.instantiate<sensor_msgs::JointState>();
    if (!joints) continue;
    for (const std::string& name : joints->name) {
      if (joints_.knows(name)) return;
      names.insert(name);
    }
  }
  throw std::runtime_error(file_ + ": neither tf nor " + topics.front() + " is about the robot: " + why +
                           ", the joint states' joints " + firstOf(names, kNamed));
}

std::string RecordedMotion::source() const {
  if (!joint_state_topics_.empty()) return joint_state_topics_.front();
  return fixed_links_ == 0 ? "tf" : "tf, and the URDF for " + std::to_string(fixed_links_) + " fixed links";
}

std::vector<std::string> RecordedMotion::warnings() const {
  std::vector<std::string> lines = joint_watch_.lines(source());
  if (!joint_state_topics_.empty() && !unnamed_.empty()) {
    lines.push_back(source() + " never gives positions of these joints of the robot: " + firstOf(unnamed_, kNamed));
  }
  return lines;
}

void RecordedMotion::play(const std::function<void(const RecordedTransforms&)>& each) const {
  readBag(file_, [&] {
    const tf2_msgs::TFMessage fixed =
        joints_.fixed(begin_, [&](const std::string& link) { return tf_frames_.count(link) == 0; });
    if (!fixed.transforms.empty()) each({begin_, fixed, true});
    std::vector<std::string> topics;
    std::copy_if(tf_topics_.begin(), tf_topics_.end(), std::back_inserter(topics), isStatic);
    if (!topics.empty() && begin_ > ros::TIME_MIN) {
      rosbag::View earlier(bag_, rosbag::TopicQuery(topics), ros::TIME_MIN, begin_ - ros::Duration(0, 1));
      for (const rosbag::MessageInstance& message : earlier) playMessage(message, each);
    }
    topics = tf_topics_;
    topics.insert(topics.end(), joint_state_topics_.begin(), joint_state_topics_.end());
    rosbag::View view(bag_, rosbag::TopicQuery(topics), begin_, end_);
    for (const rosbag::MessageInstance& message : view) playMessage(message, each);
  });
}

void RecordedMotion::playMessage(const rosbag::MessageInstance& message,
                                 const std::function<void(const RecordedTransforms&)>& each) const {
  const ros::Time recorded = std::max(message.getTime(), begin_);
  if (const auto tf = message.instantiate<tf2_msgs::TFMessage>()) {
    each({recorded, *tf, isStatic(message.getTopic())});
  } else if (const auto joints = message.instantiate<sensor_msgs::JointState>()) {
    joint_watch_.add(*joints);
    const std::size_t given = std::min(joints->name.size(), joints->position.size());
    for (std::size_t i = 0; i < given; ++i) unnamed_.erase(joints->name[i]);
    const ros::Time& stamp = joints->header.stamp;
    const tf2_msgs::TFMessage moved = joints_.moved(*joints, stamp.isZero() ? message.getTime() : stamp);
    if (!moved.transforms.empty()) each({recorded, moved, false});
  }
}

}  // namespace sdf_ccd
