#pragma once

#include <string>
#include <vector>

#include "ros/monitor/monitor_loop.h"
#include "sdf_ccd/UncheckedBody.h"

/// What the loop's last cycle did not check, and why, as texts.
namespace sdf_ccd {

/// Why none of a body's pairs can be checked; empty if they can.
const std::string& uncheckedReason(const MonitorLoop& loop, int body);

/// Whether one of the pair's bodies cannot be checked at all.
bool isOfUncheckedBody(const MonitorLoop& loop, const PairResult& pair);

/// Sets the reason why the cycle as a whole is not checked; empty if it is. Reuses the text's memory.
void setUncheckedCycle(const MonitorLoop& loop, std::string& reason);

/// Sets the bodies none of whose pairs the cycle could check. Reuses their memory.
void setUncheckedBodies(const MonitorLoop& loop, std::vector<UncheckedBody>& bodies);

/// Sets "body: reason" of those of them whose transforms are missing. Reuses the lines' memory.
void setMissingBodies(const MonitorLoop& loop, std::vector<std::string>& lines);

/// Why bodies are not checked, in one line: an example of the most frequent reason, and the number of other bodies.
/// Empty if the cycle could check all bodies.
std::string uncheckedCause(const MonitorLoop& loop);

/// "body - body: reason" of the first pair that the cycle could not check although it could check both bodies; empty if
/// there is none.
std::string uncheckedPair(const MonitorLoop& loop);

/// "body: reason" of the bodies that no cycle can check.
std::vector<std::string> failedBodies(const Scene& scene);

}  // namespace sdf_ccd
