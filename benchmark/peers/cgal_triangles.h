#pragma once

#include <cstdint>

namespace sdf_ccd::benchmark {

/// Difference between the triangle distances of the adversarial tests' oracle (test/oracle/triangle_distance.h) and
/// CGAL's, in exact arithmetic on the same coordinates.
struct OracleError {
  long pairs = 0;
  long touching = 0;     ///< pairs that touch according to CGAL
  long wrong_touch = 0;  ///< one finds contact, the other a distance above the rounding error
  double largest = 0.0;  ///< largest difference of distances, relative to the triangles' size
};

/// Compares the distances of random pairs of triangles: half in general position, half with integer coordinates from 0
/// to 2, of which most are parallel, coplanar, of no area, or touch at a vertex or an edge.
OracleError compareWithCgal(std::uint64_t seed, long pairs);

}  // namespace sdf_ccd::benchmark
