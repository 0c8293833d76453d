#pragma once

#include <functional>
#include <vector>

namespace sdf_ccd::precision {

/// Measures the run time of tasks on one thread, as CPU time of the thread. All tasks run in turn, in several rounds,
/// so that changes of the computer's load affect them alike.
/// @param tasks  each runs all `queries` once per call.
/// @param progress  called with the fraction done.
/// @return for each task, the median over the rounds [s per query].
std::vector<double> secondsPerQuery(const std::vector<std::function<void()>>& tasks, std::size_t queries,
                                    const std::function<void(double)>& progress);

}  // namespace sdf_ccd::precision
