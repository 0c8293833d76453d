#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// Closed interval of a parameter; enter ≤ exit.
struct Interval {
  double enter;
  double exit;
};

/// Disjoint and increasing.
using Intervals = std::vector<Interval>;

/// A point's straight path, frame F [m]; t = 0 at the start and 1 at the end.
struct Segment {
  Vector3d start;
  Vector3d end;
};

/// False for a segment that every query rejects: not finite, or with a coordinate above 1e12 m. There doubles are 0.1
/// mm apart, and so are the points that a parameter in [0, 1] can resolve on a path of that length.
inline bool isWithinReach(const Segment& segment) {
  return segment.start.lpNorm<Eigen::Infinity>() <= 1e12 && segment.end.lpNorm<Eigen::Infinity>() <= 1e12 &&
         segment.start.allFinite() && segment.end.allFinite();
}

/// The part of the result that is needed; less costs less.
enum class SegmentMode {
  kAll,            ///< all intervals
  kFirstInterval,  ///< the first one
  kFirst,          ///< where the first one begins, given as an interval of no length
  kAny,            ///< whether there is one: an interval of no length, somewhere in one
};

/// What is to be found on a segment.
struct SegmentOptions {
  double sigma = 0.0;  ///< isovalue [m]; 0 is the surface
  SegmentMode mode = SegmentMode::kAll;
};

/// Times during which a moving point is on or inside the isosurface φ = σ.
///
/// Source: Xu & Barbič 2014, §3.1, Eq. (2); skips: §3.2. Difference: in each cell the cubic's roots are isolated and
/// bracketed, so two crossings in one cell are found (the paper's sign test loses them).
/// @param field    φ [m], frame F.
/// @param segment  within reach, see above.
/// @param options  |sigma| ≤ field.band().
/// @param intervals  replaced by disjoint, increasing intervals within [0, 1]; empty if there is none. A point that
///                 only touches gives an interval of no length; a segment that starts inside one from 0.
/// @throws std::invalid_argument if the segment is not within reach or sigma lies outside the band.
/// Guarantee: every root of the interpolated field, to 16 spacings of doubles at the largest coordinate of the path's
/// ends (and of the field), divided by how steeply φ changes along the path there: at a coordinate of 1 m, and φ that
/// falls as fast as the point moves, 4e-15 m; at 1e8 m 0.4 µm, at 1e12 m 4 mm. A path that grazes the isosurface may
/// be given as touching it or not, by that much of φ. Outside the grid nothing is inside.
void segmentIntervals(const DistanceField& field, const Segment& segment, const SegmentOptions& options,
                      Intervals& intervals);

/// The same, returned.
Intervals segmentIntervals(const DistanceField& field, const Segment& segment, const SegmentOptions& options = {});

/// False only if the true distance exceeds `radius` at every point of the segment (paper §3.3, Figure 3):
/// conservative. Steps from one empty sphere to the next by field.lowerBound(). Also for segments outside the field's
/// box.
bool mayTouch(const DistanceField& field, const Segment& segment, double radius);

/// An interval of one segment, of its parameter in [0, 1].
struct SegmentHit {
  std::uint32_t segment;
  float enter;
  float exit;
};

/// Hits of many segments.
struct BatchResult {
  std::vector<SegmentHit> hits;  ///< by segment, then by time
};

/// segmentIntervals() for many segments at once, several to an instruction, on all threads of the caller's TBB arena.
///
/// Grids are queried in single precision: where φ falls as fast as the point moves, a hit is right to 1e-6 of a grid's
/// longest side, and a segment that grazes the isosurface closer than that may be reported as a hit or not, also beside
/// another hit. Times are floats: on a long segment they resolve points to 6e-8 of its length (6 cm on one of 1000 km)
/// and no finer. Where cells of an adaptive field differ in size, φ jumps by up to the field's error in the plane of
/// their faces, and a segment in that plane gets the value of either side. Primitives are queried one by one. The
/// result does not depend on the number of threads or on the other segments; between processors with other vector
/// instructions it may differ within the tolerance.
/// @param segments  each within reach (isWithinReach()); `count` of them, at most 2³² − 1.
/// @param options   |sigma| ≤ field.band().
/// @param result    replaced; its memory is reused.
/// @throws std::invalid_argument if a segment is not within reach (naming it) or sigma lies outside the band.
void segmentIntervals(const DistanceField& field, const Segment* segments, std::size_t count,
                      const SegmentOptions& options, BatchResult& result);

}  // namespace sdf_ccd
