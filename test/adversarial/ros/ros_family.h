#pragma once

#include "adversarial/family.h"

namespace sdf_ccd::test {

/// The family `ros`: streams of transforms as robots, bags and faulty clocks send them, passed through the history, the
/// tracker and the monitor.
Tally rosStreams(std::uint64_t seed, long cases);

}  // namespace sdf_ccd::test
