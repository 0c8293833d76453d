#include "ros/monitor/cycle_messages.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "monitor/pair_result.h"
#include "ros/messages/conversions.h"
#include "ros/monitor/unchecked.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

void setStatus(const TrackedCycle& cycle, const CycleResult& result, CycleStatus& message) {
  message.start = cycle.start;
  message.complete_until = cycle.complete_until;
  message.run_time = result.run_time;
  message.error_bound = toErrorBound(result.error);
  message.checked = result.checked;
  message.skipped = result.skipped;
  message.not_checked = result.not_checked;
  message.delayed = result.delayed;
  message.postponed = result.postponed;
  message.incomplete = result.incomplete;
  message.delayed_since = cycle.delayed_since;
  message.contradicted_since = ros::Time();
  message.late_frames.clear();
  for (const LateTransforms& late : cycle.late) {
    const bool is_first = message.contradicted_since.isZero() || late.since < message.contradicted_since;
    if (is_first) message.contradicted_since = late.since;
    message.late_frames.push_back(late.frame);
  }
}

/// Sets what both messages tell of a cycle.
template <typename Message>
void setCycle(const MonitorLoop& loop, Message& message) {
  const TrackedCycle& cycle = loop.cycle();
  const CycleResult& result = loop.result();
  message.header.stamp = cycle.end;
  message.header.frame_id = loop.fixedFrame();
  message.scene_version = loop.world()->version();
  message.verdict = numberOf(result.verdict);
  setUncheckedCycle(loop, message.reason);
  setStatus(cycle, result, message.cycle);
  setUncheckedBodies(loop, message.unchecked);
}

/// Sets the pairs that are neither clear nor delayed, without those of bodies that could not be checked at all.
void setPairs(const MonitorLoop& loop, std::vector<PairContact>& messages) {
  const auto isListed = [&](const PairResult& pair) {
    return pair.verdict != Verdict::kNotChecked || !isOfUncheckedBody(loop, pair);
  };
  setPairContacts(loop.result(), contextOf(loop), isListed, messages);
}

void setContacts(const MonitorLoop& loop, std::vector<Contact>& messages) {
  const ContactTracker& contacts = loop.contacts();
  messages.resize(contacts.size());
  for (std::size_t i = 0; i < messages.size(); ++i) setContact(contacts[i], messages[i]);
}

/// Sets the values for plots. Without subscribers to the state, contacts are not looked for: these are not known then.
void setScalars(const MonitorLoop& loop, MonitorState& message) {
  if (!hasScalars(loop)) {
    message.max_depth = message.min_clearance = message.max_force = std::numeric_limits<double>::quiet_NaN();
    message.contacts = 0;
    return;
  }
  message.max_depth = message.max_force = 0.0;
  message.min_clearance = std::numeric_limits<double>::infinity();
  bool are_depths_known = true, are_forces_known = true;
  for (const PairResult& pair : loop.result().pairs) {
    if (pair.span.empty()) continue;
    message.min_clearance =
        std::min(message.min_clearance, pair.verdict == Verdict::kClear ? std::max(0.0, pair.clearance) : 0.0);
    if (pair.intervals.empty()) continue;
    if (!isTimed(pair)) are_depths_known = false;
    if (pair.on_a_W.force.hasNaN()) are_forces_known = false;
    message.max_depth = std::max(message.max_depth, pair.deepest.depth);
    message.max_force = std::max(message.max_force, pair.on_a_W.force.norm());
  }
  if (!std::isfinite(message.min_clearance)) message.min_clearance = 0.0;
  if (!are_depths_known) message.max_depth = std::numeric_limits<double>::quiet_NaN();
  if (!are_forces_known) message.max_force = std::numeric_limits<double>::quiet_NaN();
  message.contacts = static_cast<std::uint32_t>(loop.contacts().size());
}

}  // namespace

CycleContext contextOf(const MonitorLoop& loop) {
  return {loop.scene(), loop.cycle().motion, loop.cycle().recorded, loop.cycle().origin};
}

void setContactArray(const MonitorLoop& loop, ContactArray& message) {
  setCycle(loop, message);
  setPairs(loop, message.pairs);
  setContacts(loop, message.contacts);
}

ContactArray toContactArray(const MonitorLoop& loop) {
  ContactArray message;
  setContactArray(loop, message);
  return message;
}

void setDistanceArray(const MonitorLoop& loop, double range, DistanceArray& message) {
  message.header.stamp = loop.cycle().end;
  message.header.frame_id = loop.fixedFrame();
  message.range = range;
  std::size_t count = 0;
  for (const PairDistance& pair : loop.distances()) {
    if (pair.any.width > range) continue;
    if (count == message.distances.size()) message.distances.emplace_back();
    Distance& distance = message.distances[count++];
    distance.body_a = loop.scene().bodies[pair.body_a].name;
    distance.body_b = loop.scene().bodies[pair.body_b].name;
    distance.stamp = loop.cycle().origin + ros::Duration(pair.time);
    distance.distance = pair.distance;
    distance.error = pair.error;
    distance.point_a = toPoint(pair.p_A_W);
    distance.point_b = toPoint(pair.p_B_W);
    distance.normal = toVector3(pair.normal_W);
    distance.closing_speed = pair.closing_speed;
  }
  message.distances.resize(count);
}

bool hasScalars(const MonitorLoop& loop) {
  const CycleRequest& request = loop.request();
  return request.contacts && request.wrenches && request.skipped_pairs;
}

void setMonitorState(const MonitorLoop& loop, const ros::Time& now, MonitorState& message) {
  setCycle(loop, message);
  loop.warnings().copyTo(message.warnings);
  message.latency = secondsBetween(loop.cycle().end, now);
  message.contact_error_bound = loop.result().contact_error;
  setScalars(loop, message);
  message.pairs_allowed_by_requests = static_cast<std::uint32_t>(loop.world()->allowed_by_requests);
}

MonitorState toMonitorState(const MonitorLoop& loop, const ros::Time& now) {
  MonitorState message;
  setMonitorState(loop, now, message);
  return message;
}

ContactArray toUncheckedContacts(const MonitorLoop& loop, const std::string& reason) {
  ContactArray message;
  message.header.frame_id = loop.fixedFrame();
  message.scene_version = loop.world()->version();
  message.header.stamp = message.cycle.start = loop.cycle().end;
  message.cycle.complete_until = loop.cycle().complete_until;
  message.verdict = numberOf(Verdict::kNotChecked);
  message.reason = reason;
  setContacts(loop, message.contacts);
  return message;
}

ContactArray toGap(const MonitorLoop& loop, const TimePart& gap, const std::string& reason) {
  ContactArray message = toUncheckedContacts(loop, reason);
  message.cycle.start = message.cycle.complete_until = gap.from;
  message.header.stamp = gap.until;
  message.cycle.not_checked = static_cast<std::uint32_t>(loop.scene().pairs.size());
  message.contacts.clear();  // they were reported at the start of the gap
  return message;
}

MonitorState toUncheckedState(std::uint64_t scene_version, const std::string& fixed_frame, const std::string& reason,
                              const ros::Time& now, const StandingWarnings* warnings) {
  MonitorState message;
  if (warnings) warnings->copyTo(message.warnings);
  message.scene_version = scene_version;
  message.header.stamp = now;
  message.header.frame_id = fixed_frame;
  message.verdict = numberOf(Verdict::kNotChecked);
  message.reason = reason;
  message.proximity = MonitorState::STOP;  // also before it is known whether there are thresholds
  return message;
}

void setWrenchStamped(const MonitorLoop& loop, int body, geometry_msgs::WrenchStamped& message) {
  Wrench sum_W;
  for (const int i : loop.result().not_clear) {
    const PairResult& pair = loop.result().pairs[i];
    if (pair.body_a == body) sum_W += pair.on_a_W;
    if (pair.body_b == body) sum_W += pair.on_b_W;
  }
  // About the body's origin in the world's axes; of an object that a link holds, that is not the link's origin.
  const Isometry3d &X_WB = loop.cycle().motion.X_WB[body].back(), &X_LB = loop.scene().bodies[body].X_frame_B;
  Isometry3d X_BL_W = X_WB * X_LB.inverse();
  X_BL_W.translation() -= X_WB.translation();
  message.header.stamp = loop.cycle().end;
  message.header.frame_id = loop.scene().bodies[body].frame;
  message.wrench = toWrench(expressedIn(X_BL_W, sum_W));
}

geometry_msgs::WrenchStamped toWrenchStamped(const MonitorLoop& loop, int body) {
  geometry_msgs::WrenchStamped message;
  setWrenchStamped(loop, body, message);
  return message;
}

std::string wrenchTopic(const BodyPlace& body) {
  std::string link = body.name;
  std::replace_if(
      link.begin(), link.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_' && c != '/'; }, '_');
  return "wrenches/" + link;
}

}  // namespace sdf_ccd
