#pragma once

#include "check_pair.h"

namespace sdf_ccd {

// Pairs whose bodies do not move relative to each other, and that have the motion. PairCycle::resting must be set;
// `error` is that of the bodies' relative position [m].

/// Answers a pair by what was found before. @return whether it was found.
bool isAnsweredAtRest(const PairCycle& cycle, double error, MonitoredPair& pair, PairResult& result);

/// Answers a pair that is not clear once for all, if it has rested, as if nothing moved in the world either. What is
/// known only from the motion before, as of a body in an open mesh, is left as it is.
void answerAtRest(const PairCycle& cycle, double error, MonitoredPair& pair, PairResult& result);

}  // namespace sdf_ccd
