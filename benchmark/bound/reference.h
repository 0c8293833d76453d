#pragma once

#include <vector>

#include "bound/test_points.h"

namespace sdf_ccd::benchmark {

/// Differences between the reference and CGAL [m].
struct ReferenceDifference {
  double distance = 0.0;  ///< largest difference of unsigned distances
  double hit = 0.0;       ///< largest difference of first hits, along the segment
  long lost = 0;          ///< segments for which only one of them finds a hit
};

/// Runs the queries of the reference with CGAL too (exact predicates, constructions in doubles).
ReferenceDifference compareWithCgal(const precision::ExactSurface& mesh, const std::vector<ExactPoint>& points,
                                    const std::vector<Segment>& segments);

}  // namespace sdf_ccd::benchmark
