#pragma once

#include "adversarial/family.h"

namespace sdf_ccd::test {

/// Transforms as robots, bags and faulty clocks send them, through the history, the tracker and the monitor.
Tally rosStreams(std::uint64_t seed, long cases);

}  // namespace sdf_ccd::test
