#include "ros/bag/checked_bag.h"

#include <set>

#include <std_msgs/Float64.h>

#include "ros/messages/world_markers.h"
#include "ros/monitor/plan_message.h"
#include "ros/monitor/ways_out_message.h"

namespace sdf_ccd {
namespace {

const std::string kMonitor = "/collision_monitor/";

/// Bodies that are in contact with another body.
std::set<int> touching(const CycleResult& result) {
  std::set<int> bodies;
  for (const PairResult& pair : result.pairs) {
    if (!pair.intervals.empty()) bodies.insert({pair.body_a, pair.body_b});
  }
  return bodies;
}

}  // namespace

CheckedBag::CheckedBag(BagWriter& bag, MonitorLoop& loop, const SceneDescription& scene,
                       const MonitorParameters& parameters)
    : loop_(loop),
      proximity_(parameters.proximity, loop),
      lists_distances_(parameters.proximity.report_distance > 0.0),
      drawer_(loop.fixedFrame(), parameters.markers),
      link_markers_(scene),
      bag_(bag) {}

void CheckedBag::addScene(const SceneDescription& description, const ros::Time& begin) {
  writeLatched(kMonitor + "plan", begin, toPlan(*loop_.world(), loop_.fixedFrame(), begin));
  writeLatched(kMonitor + "world", begin, toWorldMarkers(description));
}

void CheckedBag::addTransforms(const RecordedTransforms& transforms) {
  if (!transforms.is_static) return bag_.write("/tf", transforms.recorded, transforms.message);
  // A player latches only the last message of a topic, so each message holds all static transforms.
  for (const geometry_msgs::TransformStamped& transform : transforms.message.transforms) {
    static_transforms_[withoutLeadingSlash(transform.child_frame_id)] = transform;
  }
  tf2_msgs::TFMessage all;
  for (const auto& [child, transform] : static_transforms_) all.transforms.push_back(transform);
  writeLatched("/tf_static", transforms.recorded, all);
}

void CheckedBag::addCycle(const ContactArray& contacts, const ros::Time& now) {
  loop_.watchFixedFrame();
  bag_.write(kMonitor + "contacts", now, contacts);
  const CycleSafety& safety = proximity_.measure(lists_distances_);
  MonitorState state = toMonitorState(loop_, now);
  writeSafety(safety, state, now);
  const WaysOut ways = toWaysOut(loop_, proximity_.rules());
  if (!ways.ways.empty()) bag_.write(kMonitor + "ways_out", now, ways);
  if (lists_distances_) {
    DistanceArray distances;
    setDistanceArray(loop_, proximity_.parameters().report_distance, distances);
    bag_.write(kMonitor + "distances", now, distances);
  }
  for (const int body : touching(loop_.result())) {
    const Body& link = loop_.scene().bodies[body];
    if (!link.is_world) bag_.write(kMonitor + wrenchTopic(link), now, toWrenchStamped(loop_, body));
  }
  loop_.warnings().copyTo(warnings_);
  bag_.write(kMonitor + "markers", now, drawer_.draw(loop_.result(), contextOf(loop_), now, warnings_));
  addLinks(now);
}

void CheckedBag::addLinks(const ros::Time& now) {
  if (link_markers_.draw(drawer_.states().ofBodies(loop_.scene())))
    writeLatched(kMonitor + "links", now, link_markers_.markers());
}

void CheckedBag::addUnchecked(const std::string& reason, const ros::Time& now) {
  bag_.write(kMonitor + "contacts", now, toUncheckedContacts(loop_, reason));
  MonitorState state = toUncheckedState(loop_.world()->version(), loop_.fixedFrame(), reason, now, &loop_.warnings());
  writeSafety(proximity_.noCycle(), state, now);
  bag_.write(kMonitor + "markers", now, drawer_.clear(reason));
  addLinks(now);
}

/// Completes the state, and writes it.
void CheckedBag::writeSafety(const CycleSafety& safety, MonitorState& state, const ros::Time& now) {
  proximity_.setState(safety, state);
  writeLatched(kMonitor + "state", now, state);
  if (!safety.velocity_scale) return;
  std_msgs::Float64 message;
  message.data = *safety.velocity_scale;
  bag_.write(kMonitor + "velocity_scale", now, message);
}

template <class Message>
void CheckedBag::writeLatched(const std::string& topic, const ros::Time& now, const Message& message) {
  boost::shared_ptr<ros::M_string>& connection = latched_connections_[topic];
  if (!connection) {
    namespace traits = ros::message_traits;
    connection = boost::make_shared<ros::M_string>(ros::M_string{{"type", traits::datatype<Message>()},
                                                                 {"md5sum", traits::md5sum<Message>()},
                                                                 {"message_definition", traits::definition<Message>()},
                                                                 {"latching", "1"}});
  }
  bag_.write(topic, now, message, connection);
}

}  // namespace sdf_ccd
