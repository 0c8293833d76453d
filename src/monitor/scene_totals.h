#pragma once

#include <cstddef>

#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// Sets BodyReport::pairs, the number of pairs of each body.
void countPairs(Scene& scene);

/// Number of pairs of two bodies of the world, none of which is tested.
std::size_t pairsOfObjects(const BodyList& bodies);

/// Sets the largest error bounds of verdicts and of contacts, for each body and for the scene.
void setBounds(Scene& scene);

}  // namespace sdf_ccd
