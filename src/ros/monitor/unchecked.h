#pragma once

#include <string>
#include <vector>

#include "ros/monitor/monitor_loop.h"

/// What the loop's last cycle did not check, and why, as texts.
namespace sdf_ccd {

/// Why none of a body's pairs can be checked; empty if they can.
const std::string& uncheckedReason(const MonitorLoop& loop, int body);

/// Whether one of the pair's bodies cannot be checked at all.
bool isOfUncheckedBody(const MonitorLoop& loop, const PairResult& pair);

/// Sets the reason why the cycle as a whole is not checked; empty if it is. Reuses the text's memory.
void setUncheckedCycle(const MonitorLoop& loop, std::string& reason);

/// Sets "body: reason" of the bodies that the cycle could not check because transforms are missing, then `others`.
/// Reuses the lines' memory.
void setMissingBodies(const MonitorLoop& loop, const std::vector<std::string>& others, std::vector<std::string>& lines);

/// Why bodies are not checked, in one line: an example of the most frequent reason, and the number of other bodies.
/// Empty if the cycle could check all bodies.
std::string uncheckedCause(const MonitorLoop& loop);

/// "body - body: reason" of the first pair that the cycle could not check although it could check both bodies; empty if
/// there is none.
std::string uncheckedPair(const MonitorLoop& loop);

/// "body: reason" of the bodies that no cycle can check.
std::vector<std::string> failedBodies(const Scene& scene);

}  // namespace sdf_ccd
