#pragma once

#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// Sets how many pairs each body is in: BodyReport::pairs.
void countPairs(Scene& scene);

/// Sets the largest error bounds of each body's pairs and of all, of verdicts and of contacts.
void setBounds(Scene& scene);

}  // namespace sdf_ccd
