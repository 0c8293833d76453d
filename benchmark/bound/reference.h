#pragma once

#include <vector>

#include "bound/places.h"

namespace sdf_ccd::benchmark {

/// How far the reference is from CGAL's [m].
struct ReferenceDifference {
  double distance = 0.0;  ///< largest, without signs
  double hit = 0.0;       ///< largest, between first hits along a segment
  long lost = 0;          ///< segments that only one of them finds a hit of
};

/// Asks CGAL (exact predicates, constructions in doubles) the same as the reference.
ReferenceDifference compareWithCgal(const precision::ExactSurface& mesh, const std::vector<ExactPlace>& places,
                                    const std::vector<Segment>& segments);

}  // namespace sdf_ccd::benchmark
