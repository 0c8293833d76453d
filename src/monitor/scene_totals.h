#pragma once

#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// Sets BodyReport::pairs, the number of pairs of each body.
void countPairs(Scene& scene);

/// Sets the largest error bounds of verdicts and of contacts, for each body and for the scene.
void setBounds(Scene& scene);

}  // namespace sdf_ccd
