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

/// What the results of the loop's last cycle refer to.
CycleContext contextOf(const MonitorLoop& loop);

/// The messages about the loop's last cycle, complete, in its fixed frame. What is called set… sets all of a message
/// that may have been another before, and uses its memory again.
void setContactArray(const MonitorLoop& loop, ContactArray& message);
ContactArray toContactArray(const MonitorLoop& loop);

/// Of the pairs that the loop has measured, those up to the range [m].
void setDistanceArray(const MonitorLoop& loop, double range, DistanceArray& message);

/// @param now  when it is sent, for its latency.
void setMonitorState(const MonitorLoop& loop, const ros::Time& now, MonitorState& message);
MonitorState toMonitorState(const MonitorLoop& loop, const ros::Time& now);

/// The messages that nothing is checked after the loop's last cycle.
ContactArray toUncheckedContacts(const MonitorLoop& loop, const std::string& reason);
/// Nor over this part of the time, all at once: after it, everything begins anew, or ends.
ContactArray toGap(const MonitorLoop& loop, const TimePart& gap, const std::string& reason);
MonitorState toUncheckedState(const std::string& fixed_frame, const std::string& reason, const ros::Time& now);

/// Sum of the contact wrenches on a body, in its frame, about its origin [N, N·m].
void setWrenchStamped(const MonitorLoop& loop, int body, geometry_msgs::WrenchStamped& message);
geometry_msgs::WrenchStamped toWrenchStamped(const MonitorLoop& loop, int body);

/// Below the monitor's name; bodies may be named by characters that names of topics may not hold.
std::string wrenchTopic(const Body& body);

/// "body: reason" of the bodies that the cycle could not check for want of transforms.
std::vector<std::string> missingBodies(const MonitorLoop& loop);

/// In one line, why bodies are not checked: an example of the reason that most of them have, and how many others there
/// are. Empty if the cycle could check all of them.
std::string uncheckedCause(const MonitorLoop& loop);

/// "body - body: reason" of the first pair that the cycle could not check although it could check both bodies; empty if
/// there is none.
std::string uncheckedPair(const MonitorLoop& loop);

/// "body: reason" of those that no cycle can check.
std::vector<std::string> failedBodies(const Scene& scene);

}  // namespace sdf_ccd
