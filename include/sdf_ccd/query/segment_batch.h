#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/query/segment_query.h"

namespace sdf_ccd {

/// An interval of one segment, of its parameter in [0, 1].
struct SegmentHit {
  std::uint32_t segment;
  float enter;
  float exit;
};

struct BatchResult {
  std::vector<SegmentHit> hits;  ///< by segment, then by time
};

/// segmentIntervals() for many segments at once, several to an instruction, on all threads of the caller's TBB arena.
///
/// Grids are queried in single precision: where φ falls as fast as the point moves, a hit is right to 1e-6 of a grid's
/// longest side, and a segment that grazes the isosurface closer than that may be reported as a hit or not. Times are
/// floats: on a long segment they resolve points to 6e-8 of its length (6 cm on one of 1000 km) and no finer.
/// Primitives are queried one by one. The result does not depend on the number of threads or on the other segments;
/// between processors with other vector instructions it may differ within the tolerance.
/// @param segments  each within reach (isWithinReach()); `count` of them, at most 2³² − 1.
/// @param options   |sigma| ≤ field.band().
/// @param result    replaced; its memory is reused.
/// @throws std::invalid_argument if a segment is not within reach (naming it) or sigma lies outside the band.
void segmentIntervals(const DistanceField& field, const Segment* segments, std::size_t count,
                      const SegmentOptions& options, BatchResult& result);

}  // namespace sdf_ccd
