#pragma once

#include "body/body_triangles.h"
#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

/// What fields and shells tell of a pair before it moves is off by: the field's error and the gap between points; zero
/// if its fields or shells were not built.
ErrorBound pairBound(const Scene& scene, const PlannedPair& pair);

/// Whether triangles decide about the pair.
inline bool hasTriangles(const Scene& scene, const PlannedPair& pair) {
  return scene.bodies[pair.body_a].triangles && scene.bodies[pair.body_b].triangles;
}

/// What a pair's verdict is off by before it moves: what triangles deviate by where they decide, else as pairBound().
ErrorBound verdictBound(const Scene& scene, const PlannedPair& pair);

}  // namespace sdf_ccd
