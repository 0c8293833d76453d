#pragma once

#include <string>

#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {

/// Resets the result, but keeps its span and its allocated memory.
void clear(PairResult& result);

/// Sets the result of a pair that is clear without a test. @param clearance  lower bound of its distance [m].
void setSkipped(const ErrorBound& error, double clearance, PairResult& result);

void setNotChecked(const std::string& reason, PairResult& result);

}  // namespace sdf_ccd
