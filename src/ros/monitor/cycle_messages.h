#pragma once

#include <string>
#include <vector>

#include <geometry_msgs/WrenchStamped.h>

#include "ros/messages/conversions.h"
#include "ros/monitor/monitor_loop.h"
#include "sdf_ccd/ContactArray.h"
#include "sdf_ccd/DistanceArray.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd {

/// Data that the results of the loop's last cycle refer to.
CycleContext contextOf(const MonitorLoop& loop);

/// The messages about the loop's last cycle, in its fixed frame. Functions named set… set all fields of a message,
/// whatever it held before, and reuse its memory.
void setContactArray(const MonitorLoop& loop, ContactArray& message);
ContactArray toContactArray(const MonitorLoop& loop);

/// Sets those of the measured pairs that are within the range [m].
void setDistanceArray(const MonitorLoop& loop, double range, DistanceArray& message);

/// Whether the last cycle was requested with all that the values for plots need; else they are NaN.
bool hasScalars(const MonitorLoop& loop);

/// @param now  time of sending, for the latency.
void setMonitorState(const MonitorLoop& loop, const ros::Time& now, MonitorState& message);
MonitorState toMonitorState(const MonitorLoop& loop, const ros::Time& now);

/// The messages that report that nothing is checked after the loop's last cycle.
ContactArray toUncheckedContacts(const MonitorLoop& loop, const std::string& reason);
/// The same for a whole gap between cycles, sent at its end: cycles then start again, or have ended.
ContactArray toGap(const MonitorLoop& loop, const TimePart& gap, const std::string& reason);
/// @param scene_version  0 if there is no scene yet.
/// @param warnings       MonitorLoop::warnings(); null if there is no loop yet.
MonitorState toUncheckedState(std::uint64_t scene_version, const std::string& fixed_frame, const std::string& reason,
                              const ros::Time& now, const StandingWarnings* warnings);

/// Sum of the contact wrenches on a body, in its frame, about its origin [N, N·m].
void setWrenchStamped(const MonitorLoop& loop, int body, geometry_msgs::WrenchStamped& message);
geometry_msgs::WrenchStamped toWrenchStamped(const MonitorLoop& loop, int body);

/// Topic below the monitor's name. Characters in the body's name that are not allowed in topics are replaced.
std::string wrenchTopic(const BodyPlace& body);

}  // namespace sdf_ccd
