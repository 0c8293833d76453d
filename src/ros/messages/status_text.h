#pragma once

#include <string>
#include <vector>

#include "ros/messages/pair_states.h"

namespace sdf_ccd {

/// Status for a viewer: verdict and largest depth or clearance, error bound, age of the results, number of pairs that
/// are not checked and why, warnings. Several lines.
/// @param age  of the results [s].
/// @param warnings  as in MonitorState; their first lines.
std::string statusText(const PairStates& states, const CycleResult& result, const CycleContext& cycle, double age,
                       const std::vector<std::string>& warnings);

/// Status while nothing is checked, for this reason.
std::string uncheckedText(const std::string& reason);

/// Lines of at most `width` characters, broken at blanks where there are any.
std::string wrapped(const std::string& text, std::size_t width);

int lineCount(const std::string& text);

}  // namespace sdf_ccd
