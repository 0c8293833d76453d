#pragma once

#include <cstddef>

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// A scene without bodies yet, as planned.
Scene plannedScene(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options);

/// Completes the reports of what was built: why other parts are not ready.
void setParts(const ScenePlan& plan, Scene& scene);

/// Sets what follows from the pairs: BodyReport::pairs, the number of pairs of each body, and the largest error bounds
/// of verdicts and of contacts, for each body and for the scene.
void setTotals(Scene& scene);

/// Number of pairs of two bodies of the world, none of which is tested.
std::size_t pairsOfObjects(const BodyList& bodies);

}  // namespace sdf_ccd
