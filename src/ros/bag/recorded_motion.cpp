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
#include "ros/tf/prefix_hint.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kNamed = 4;  // examples in an error
constexpr const char* kConvert = "convert the bag with `rosbag fix`";

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
  origin_ = first;
  begin_ = first + ros::Duration(options_.start);
  end_ = options_.duration < (last - begin_).toSec() ? begin_ + ros::Duration(options_.duration) : last;

  const std::string tf_type = ros::message_traits::md5sum<tf2_msgs::TFMessage>();  // that of tf/tfMessage is the same
  std::set<std::string> tf, other_tf, joint_states;
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    const std::string name = withoutLeadingSlash(connection->topic);
    const bool is_read = name == "tf" || name == "tf_static";
    if (is_read) requireDefinition<tf2_msgs::TFMessage>(*connection, file_, kConvert);
    requireDefinition<sensor_msgs::JointState>(*connection, file_, kConvert);
    if (connection->md5sum == tf_type) (is_read ? tf : other_tf).insert(connection->topic);
    if (connection->datatype == "sensor_msgs/JointState") joint_states.insert(connection->topic);
  }
  tf_topics_.assign(tf.begin(), tf.end());
  joint_state_topics_.assign(joint_states.begin(), joint_states.end());
  if (tf.empty() && joint_states.empty()) {
    throw std::runtime_error(file_ + ": holds neither tf nor joint states" +
                             (other_tf.empty() ? ""
                                               : "; its transforms are on " + firstOf(other_tf, kNamed) +
                                                     ", and only those on /tf and /tf_static are read"));
  }
}

void RecordedMotion::findFrames(const DescribedScene& described) {
  const std::vector<std::string> links = joints_.frames();
  std::set<std::string> wanted(links.begin(), links.end());
  if (described.fixed_frame != described.root_frame) wanted.insert(described.fixed_frame);
  rosbag::View view(bag_, rosbag::TopicQuery(tf_topics_), ros::TIME_MIN, end_);
  for (auto message = view.begin(); message != view.end() && !wanted.empty(); ++message) {
    const tf2_msgs::TFMessage::ConstPtr tf = messageOf<tf2_msgs::TFMessage>(*message);
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
  const std::vector<std::string> movable = joints_.movableFrames();
  const std::vector<std::string>& telling = joint_state_topics_.empty() ? links : movable;
  const bool has_tf = std::any_of(telling.begin(), telling.end(), isNamed) || (telling.empty() && !tf_topics_.empty());
  if (!has_tf && links.empty()) {
    throw std::runtime_error(file_ + ": holds no tf, and the robot has no other links whose joints could move");
  }
  chooseJointStates(described, movable, has_tf);
  fixed_links_ = joints_.fixed(begin_, [&](const std::string& link) { return !isNamed(link); }).transforms.size();
  const bool is_link = std::find(links.begin(), links.end(), described.fixed_frame) != links.end();
  if (wanted.count(described.fixed_frame) > 0 && !is_link) {
    throw std::runtime_error(file_ + ": the fixed frame " + described.fixed_frame +
                             " is neither in tf nor a link of the robot");
  }
}

void RecordedMotion::chooseJointStates(const DescribedScene& described, const std::vector<std::string>& movable,
                                       bool has_tf) {
  const auto isInTf = [&](const std::string& frame) { return tf_frames_.count(frame) > 0; };
  std::vector<std::string> lacking;
  std::remove_copy_if(movable.begin(), movable.end(), std::back_inserter(lacking), isInTf);
  const bool is_asked = !options_.joint_states.empty();
  const bool has_any = !joint_state_topics_.empty();
  const std::string problem = is_asked || !has_tf || !lacking.empty() ? findJointStates() : "the tf is complete";
  if (!problem.empty()) joint_state_topics_.clear();
  if (!problem.empty() && is_asked) throw std::runtime_error(file_ + ": " + problem);
  if (!problem.empty() && !has_tf) {
    const std::string hint = prefixHint(joints_.frames(), {tf_frames_.begin(), tf_frames_.end()});
    throw std::runtime_error(file_ + ": " +
                             (tf_topics_.empty() ? "contains no tf" : "its tf names no link of the robot") + ", and " +
                             problem + ": the links are " + firstOf(joints_.frames(), kNamed) +
                             (tf_topics_.empty() ? "" : ", the tf's frames " + firstOf(tf_frames_, kNamed)) +
                             (hint.empty() ? "" : "; " + hint));
  }
  if (!is_asked) {
    std::set<std::string> filled;
    for (const std::string& frame : lacking)
      if (joint_frames_.count(frame) > 0) filled.insert(frame);
    joint_frames_ = std::move(filled);
  }
  for (const auto& [name, joint] : described.robot->urdf().joints_) {
    const std::string frame = described.frames()(joint->child_link_name);
    if (isInTf(frame) && joint_frames_.count(frame) == 0) unnamed_.erase(name);
  }
  if (!problem.empty() && has_any && !lacking.empty())
    lacking_ = "tf does not have the links " + firstOf(lacking, kNamed) + ", and " + problem;
  is_by_joints_ = !joint_frames_.empty() && (!has_tf || joint_frames_.size() == movable.size());
}

std::string RecordedMotion::findJointStates() {
  std::vector<std::string>& topics = joint_state_topics_;
  const bool is_asked = !options_.joint_states.empty();
  const std::string wanted = is_asked ? options_.joint_states : "joint_states";
  const auto chosen = std::find_if(topics.begin(), topics.end(), [&](const std::string& topic) {
    return withoutLeadingSlash(topic) == withoutLeadingSlash(wanted);
  });
  if (chosen != topics.end()) {
    topics = {std::string(*chosen)};
  } else if (is_asked || topics.empty()) {
    return "it contains no joint states" + (is_asked ? " on " + wanted : "");
  } else if (topics.size() > 1) {
    return "it holds joint states on " + firstOf(topics, kNamed) + ": choose one of them with --joint-states";
  }
  std::set<std::string> names, left = unnamed_;
  rosbag::View view(bag_, rosbag::TopicQuery(topics), ros::TIME_MIN, end_);
  for (auto message = view.begin(); message != view.end() && !left.empty(); ++message) {
    const sensor_msgs::JointState::ConstPtr joints = messageOf<sensor_msgs::JointState>(*message);
    if (!joints) continue;
    names.insert(joints->name.begin(), joints->name.end());
    for (const std::string& name : joints->name) left.erase(name);
  }
  const std::vector<std::string> moved = joints_.movedFrames(names);
  joint_frames_.insert(moved.begin(), moved.end());
  return moved.empty() ? topics.front() + " is not about the robot, its joints are " + firstOf(names, kNamed) : "";
}

std::string RecordedMotion::source() const {
  if (is_by_joints_) return joint_state_topics_.front();
  std::string text = "tf";
  if (!joint_frames_.empty())
    text += ", " + joint_state_topics_.front() + " for " + counted(joint_frames_.size(), "link");
  return fixed_links_ == 0 ? text : text + ", and the URDF for " + std::to_string(fixed_links_) + " fixed links";
}

std::vector<std::string> RecordedMotion::warnings() const {
  if (joint_state_topics_.empty()) return lacking_.empty() ? std::vector<std::string>() : std::vector{lacking_};
  const std::string& topic = joint_state_topics_.front();
  std::vector<std::string> lines = joint_watch_.lines(topic);
  if (!unnamed_.empty())
    lines.push_back(topic + " never gives positions of these joints of the robot: " + firstOf(unnamed_, kNamed));
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
  const auto keep = [&](tf2_msgs::TFMessage transforms, bool of_joints, bool is_static) {
    auto& all = transforms.transforms;
    const auto isOther = [&](const geometry_msgs::TransformStamped& transform) {
      return joint_frames_.count(withoutLeadingSlash(transform.child_frame_id)) != (of_joints ? 1 : 0);
    };
    all.erase(std::remove_if(all.begin(), all.end(), isOther), all.end());
    if (!all.empty()) each({recorded, transforms, is_static});
  };
  if (const auto tf = messageOf<tf2_msgs::TFMessage>(message)) {
    keep(*tf, false, isStatic(message.getTopic()));
  } else if (const auto joints = messageOf<sensor_msgs::JointState>(message)) {
    joint_watch_.add(*joints);
    const std::size_t given = std::min(joints->name.size(), joints->position.size());
    for (std::size_t i = 0; i < given; ++i) unnamed_.erase(joints->name[i]);
    const ros::Time& stamp = joints->header.stamp;
    keep(joints_.moved(*joints, stamp.isZero() ? message.getTime() : stamp), true, false);
  }
}

}  // namespace sdf_ccd
