#pragma once

#include <cstdint>

namespace sdf_ccd::benchmark {

/// How far the distances of triangles that the adversaries' truth rests on (test/oracle/triangle_distance.h) are from
/// CGAL's, with exact arithmetic on the same coordinates.
struct OracleError {
  long pairs = 0;
  long touching = 0;     ///< by CGAL
  long wrong_touch = 0;  ///< one says that they touch, the other that they are more than a rounding apart
  double largest = 0.0;  ///< difference of distances over the size of the triangles
};

/// Pairs of triangles: in general position, and with whole coordinates so small that most are parallel, in one plane,
/// of no area, or touch at a corner or an edge.
OracleError compareWithCgal(std::uint64_t seed, long pairs);

}  // namespace sdf_ccd::benchmark
