#pragma once

#include <functional>
#include <vector>

#include "contact_query.h"
#include "peers.h"

namespace sdf_ccd::precision {

/// A motion of a body that meets one at rest, with the exact time of impact.
struct ExactImpact {
  Motion motion;
  double time;    ///< in (0, 1)
  double travel;  ///< upper bound of the travel of all points [m]
};

/// Cost and error of every system over the same motions; errors of times as lengths of travel. A system that finds no
/// impact at all has no row.
/// @param progress  called with the fraction done.
std::vector<Measurement> measureImpacts(const std::vector<ImpactSystem>& systems, const std::vector<ExactImpact>& exact,
                                        const std::function<void(double)>& progress);

}  // namespace sdf_ccd::precision
