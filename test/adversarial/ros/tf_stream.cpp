#include "adversarial/ros/tf_stream.h"

#include <algorithm>
#include <cmath>

namespace sdf_ccd::test {
namespace {

constexpr double kBegin = 1000.0, kLength = 3.0;  // [s]

geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child, double stamp,
                                          const Isometry3d& X) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = ros::Time(stamp);
  message.child_frame_id = child;
  const Quaterniond q(X.linear());
  message.transform.rotation.w = q.w();
  message.transform.rotation.x = q.x();
  message.transform.rotation.y = q.y();
  message.transform.rotation.z = q.z();
  message.transform.translation.x = X.translation().x();
  message.transform.translation.y = X.translation().y();
  message.transform.translation.z = X.translation().z();
  return message;
}

/// A joint that rotates at a constant rate, with oscillations.
struct JointMotion {
  std::string parent, child;
  Vector3d axis, place, swing;
  double rate, amplitude, frequency, period, phase;

  Isometry3d pose(double time) const {
    const double t = time - kBegin;
    Isometry3d X = Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(rate * t + amplitude * std::sin(frequency * t + phase), axis).toRotationMatrix();
    X.translation() = place + std::sin(frequency * t) * swing;
    return X;
  }
};

JointMotion randomJoint(Random& random, const std::string& parent, const std::string& child, double fastest) {
  JointMotion joint;
  joint.parent = parent;
  joint.child = child;
  joint.axis = direction(random);
  joint.place = parent == "world" ? Vector3d(uniform(random, 0.0, 0.8) * direction(random)) : Vector3d(0.1, 0.0, 0.05);
  joint.swing = uniform(random, 0.0, 0.1) * direction(random);
  joint.frequency = uniform(random, 0.5, 6.0);
  joint.period = random() % 2 ? 0.1 : uniform(random, 0.02, 0.12);
  // Slow enough that two successive transforms determine the direction of rotation.
  joint.rate = random() % 4 == 0 ? 0.0 : uniform(random, -fastest, fastest);
  joint.amplitude = uniform(random, 0.0, 0.5);
  joint.phase = uniform(random, 0.0, 6.0);
  return joint;
}

void send(const JointMotion& joint, Random& random, std::vector<TfEvent>& events) {
  for (double t = kBegin + uniform(random, 0.0, joint.period); t < kBegin + kLength; t += joint.period)
    events.push_back({t, transform(joint.parent, joint.child, t, joint.pose(t)), false, false});
}

}  // namespace

std::vector<TfEvent> randomStream(Random& random, Trouble trouble) {
  const double fastest = random() % 2 ? 2.0 : 12.0;  // [rad/s]
  const std::vector<JointMotion> joints{randomJoint(random, "world", "arm", fastest),
                                        randomJoint(random, "world", "base", 1.0),
                                        randomJoint(random, "base", "hand", fastest)};
  const std::size_t odd = random() % joints.size();
  const double from = kBegin + uniform(random, 0.5, 1.5), until = from + uniform(random, 0.1, 1.2);
  std::vector<TfEvent> events;
  const double late = trouble == Trouble::kLate ? uniform(random, 0.05, 0.4) : 0.0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    std::vector<TfEvent> sent;
    send(joints[j], random, sent);
    const std::string& child = joints[j].child;
    for (TfEvent& event : sent) {
      const double stamp = event.arrival;
      if (j == odd) {
        event.arrival += late * uniform(random, 0.8, 1.0);
        if (trouble == Trouble::kSilent && stamp > from && stamp < until) continue;
        if (trouble == Trouble::kOutOfOrder && random() % 4 == 0) event.arrival += 1.5 * joints[j].period;
        if (trouble == Trouble::kStaticThenMoving && stamp < from) continue;
        if (trouble == Trouble::kMovingThenStatic && stamp > from) continue;
        if (trouble == Trouble::kTwoClocks && random() % 3 == 0) {
          TfEvent other = event;
          const double apart = random() % 2 ? 0.05 : 1.5;
          other.transform = transform(joints[j].parent, child, stamp - apart, joints[j].pose(stamp - apart));
          other.arrival += 1e-3;
          other.jumps_back = apart > 1.0;
          events.push_back(other);
        }
      }
      events.push_back(event);
    }
    if (j != odd) continue;
    if (trouble == Trouble::kStaticThenMoving)
      events.push_back({kBegin, transform(joints[j].parent, child, kBegin, joints[j].pose(from)), true, false});
    if (trouble == Trouble::kMovingThenStatic)
      events.push_back({from, transform(joints[j].parent, child, from, joints[j].pose(from)), true, false});
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const TfEvent& a, const TfEvent& b) { return a.arrival < b.arrival; });
  if (trouble == Trouble::kLoop) {
    events.resize(events.size() * 2 / 3);
    std::vector<TfEvent> again = events;
    again.front().jumps_back = true;
    events.insert(events.end(), again.begin(), again.end());
  }
  return events;
}

}  // namespace sdf_ccd::test
