#pragma once

#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {

/// Sets what a result says of all its pairs from what it says of each: verdict, error bound and counts.
void summarise(CycleResult& result);

/// Lists the pairs as NOT_CHECKED behind those of the scene: what would be CLEAR as a whole is not.
void addUnchecked(const std::vector<UncheckedPair>& pairs, CycleResult& result);

}  // namespace sdf_ccd
