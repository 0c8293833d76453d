#pragma once

#include "sdf_ccd/scene/monitor.h"

namespace sdf_ccd {

/// Sets what a result says of all its pairs from what it says of each: verdict, error bound and counts.
void summarise(CycleResult& result);

}  // namespace sdf_ccd
