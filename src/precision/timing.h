#pragma once

#include <functional>
#include <vector>

namespace sdf_ccd::precision {

/// Compares the times of tasks: runs all of them one after the other, in several rounds, so that changes of the
/// machine's load affect them alike. On one thread, by thread time.
/// @param tasks  each does all `queries` once per call.
/// @param progress  called with the share done.
/// @return per task the median over the rounds [s per query].
std::vector<double> secondsPerQuery(const std::vector<std::function<void()>>& tasks, std::size_t queries,
                                    const std::function<void(double)>& progress);

}  // namespace sdf_ccd::precision
