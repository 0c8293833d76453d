#pragma once

#include <functional>
#include <vector>

namespace sdf_ccd::precision {

/// Times tasks against each other: all of them in turn, several rounds, so that a change of the machine's load meets
/// them alike. On one thread, by its own time.
/// @param tasks  each does all `queries` once per call.
/// @param progress  called with the share done.
/// @return per task the median over the rounds [s per query].
std::vector<double> secondsPerQuery(const std::vector<std::function<void()>>& tasks, std::size_t queries,
                                    const std::function<void(double)>& progress);

}  // namespace sdf_ccd::precision
