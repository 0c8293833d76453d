#pragma once

#include <string>
#include <vector>

#include "ros/messages/pair_states.h"

namespace sdf_ccd {

/// What a viewer is told in words: verdict and deepest depth or clearance, error bound, age of what is known, how many
/// pairs are not checked and why. Several lines.
/// @param age  [s].
std::string statusText(const PairStates& states, const CycleResult& result, const CycleContext& cycle, double age);

/// The same while nothing is checked, for this reason.
std::string uncheckedText(const std::string& reason);

/// In mm, from one metre on in m.
std::string lengthText(double length);

/// Lines of at most `width` characters, broken at blanks where there are any.
std::string wrapped(const std::string& text, std::size_t width);

int lineCount(const std::string& text);

}  // namespace sdf_ccd
