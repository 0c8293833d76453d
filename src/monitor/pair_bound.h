#pragma once

#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

/// What is known of a pair's error bound before it moves: the field's error and the gap between points; zero if its
/// fields or shells were not built.
ErrorBound pairBound(const Scene& scene, const PlannedPair& pair);

}  // namespace sdf_ccd
