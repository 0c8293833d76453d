#include "ros/cycle_messages.h"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>

namespace sdf_ccd {

namespace {

template <typename Message>
void setErrorBound(const CycleResult& result, Message& message) {
  message.error_bound = result.error_bound;
  message.error_field = result.error.field;
  message.error_chord = result.error.chord;
  message.error_root = result.error.root;
  message.error_gap = result.error.gap;
}

template <typename Message>
void setDelays(const TrackedCycle& cycle, Message& message) {
  message.delayed_since = cycle.delayed_since;
  message.contradicted_since = ros::Time();
  message.late_frames.clear();
  for (const LateTransforms& late : cycle.late) {
    const bool is_first = message.contradicted_since.isZero() || late.since < message.contradicted_since;
    if (is_first) message.contradicted_since = late.since;
    message.late_frames.push_back(late.frame);
  }
}

/// Why a cycle as a whole is not checked; empty if it is.
std::string reasonOf(const CycleResult& result, const TrackedCycle& cycle) {
  if (result.verdict != Verdict::kNotChecked) return "";
  if (result.pairs.empty()) return "no pairs: there is nothing to check";
  std::string reason;
  if (result.not_checked > 0) reason = std::to_string(result.not_checked) + " pairs could not be checked";
  if (result.delayed > 0) {
    reason += fmt::format("{}{} pairs wait for transforms, up to {:.3f} s already", reason.empty() ? "" : ", ",
                          result.delayed, (cycle.end - cycle.delayed_since).toSec());
  }
  return reason;
}

}  // namespace

CycleContext contextOf(const MonitorLoop& loop) {
  return {loop.scene(), loop.cycle().motion, loop.cycle().samples, loop.cycle().origin};
}

void setContactArray(const MonitorLoop& loop, ContactArray& message) {
  const TrackedCycle& cycle = loop.cycle();
  const CycleResult& result = loop.result();
  message.header.stamp = cycle.end;
  message.header.frame_id = loop.fixedFrame();
  message.cycle_start = cycle.start;
  message.complete_until = cycle.complete_until;
  message.run_time = result.run_time;
  message.verdict = static_cast<std::uint8_t>(result.verdict);
  message.reason = reasonOf(result, cycle);
  setErrorBound(result, message);
  setDelays(cycle, message);
  setPairContacts(result, contextOf(loop), message.pairs);
  message.checked = result.checked;
  message.skipped = result.skipped;
  message.not_checked = result.not_checked;
  message.delayed = result.delayed;
}

ContactArray toContactArray(const MonitorLoop& loop) {
  ContactArray message;
  setContactArray(loop, message);
  return message;
}

void setMonitorState(const MonitorLoop& loop, const ros::Time& now, MonitorState& message) {
  const TrackedCycle& cycle = loop.cycle();
  const CycleResult& result = loop.result();
  message.header.stamp = cycle.end;
  message.header.frame_id = loop.fixedFrame();
  message.verdict = static_cast<std::uint8_t>(result.verdict);
  message.missing = missingBodies(loop);
  for (const Body& body : loop.scene().bodies) {
    if (!body.failure.empty()) message.missing.push_back(body.name + ": " + body.failure);
  }
  message.reason = reasonOf(result, cycle);
  message.cycle_start = cycle.start;
  message.complete_until = cycle.complete_until;
  message.run_time = result.run_time;
  message.latency = (now - cycle.end).toSec();
  setErrorBound(result, message);
  setDelays(cycle, message);
  message.pairs_checked = result.checked;
  message.pairs_skipped = result.skipped;
  message.pairs_not_checked = result.not_checked;
  message.pairs_delayed = result.delayed;
}

MonitorState toMonitorState(const MonitorLoop& loop, const ros::Time& now) {
  MonitorState message;
  setMonitorState(loop, now, message);
  return message;
}

ContactArray toUncheckedContacts(const MonitorLoop& loop, const std::string& reason) {
  ContactArray message;
  message.header.frame_id = loop.fixedFrame();
  message.header.stamp = message.cycle_start = message.complete_until = loop.cycle().end;
  message.verdict = ContactArray::NOT_CHECKED;
  message.reason = reason;
  return message;
}

MonitorState toUncheckedState(const std::string& fixed_frame, const std::string& reason, const ros::Time& now) {
  MonitorState message;
  message.header.stamp = now;
  message.header.frame_id = fixed_frame;
  message.verdict = MonitorState::NOT_CHECKED;
  message.reason = reason;
  return message;
}

void setWrenchStamped(const MonitorLoop& loop, int body, geometry_msgs::WrenchStamped& message) {
  Wrench sum_W;
  for (const PairResult& pair : loop.result().pairs) {
    if (pair.body_a == body) sum_W += pair.on_a_W;
    if (pair.body_b == body) sum_W += pair.on_b_W;
  }
  const Isometry3d R_WB(loop.cycle().motion.X_WB[body].back().linear());
  message.header.stamp = loop.cycle().end;
  message.header.frame_id = loop.scene().bodies[body].frame;
  message.wrench = toWrench(expressedIn(R_WB, sum_W));
}

geometry_msgs::WrenchStamped toWrenchStamped(const MonitorLoop& loop, int body) {
  geometry_msgs::WrenchStamped message;
  setWrenchStamped(loop, body, message);
  return message;
}

std::string wrenchTopic(const Body& body) {
  std::string link = body.name;
  std::replace_if(
      link.begin(), link.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_' && c != '/'; }, '_');
  return "wrenches/" + link;
}

std::vector<std::string> missingBodies(const MonitorLoop& loop) {
  const std::vector<std::string>& missing = loop.cycle().motion.missing;
  std::vector<std::string> lines;
  for (std::size_t body = 0; body < missing.size(); ++body) {
    if (!missing[body].empty()) lines.push_back(loop.scene().bodies[body].name + ": " + missing[body]);
  }
  return lines;
}

std::string uncheckedCause(const MonitorLoop& loop) {
  const std::vector<std::string> missing = missingBodies(loop);
  if (missing.empty()) return "no new transforms come";
  const auto causeOf = [](const std::string& line) { return line.substr(line.rfind(": ") + 1); };
  std::map<std::string, std::size_t> bodies;  // by cause
  for (const std::string& line : missing) ++bodies[causeOf(line)];
  const auto shares = [&](const std::string& a, const std::string& b) {
    return bodies[causeOf(a)] < bodies[causeOf(b)];
  };
  const std::size_t others = missing.size() - 1;
  return *std::max_element(missing.begin(), missing.end(), shares) +
         (others == 0   ? ""
          : others == 1 ? "; and 1 body more"
                        : "; and " + std::to_string(others) + " bodies more");
}

std::vector<std::string> failedBodies(const Scene& scene) {
  std::vector<std::string> lines;
  for (const Body& body : scene.bodies) {
    if (!body.failure.empty()) lines.push_back(body.name + ": " + body.failure);
  }
  return lines;
}

}  // namespace sdf_ccd
