#pragma once

#include <vector>

#include "motion/chords.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"
#include "shell/point_shell.h"

namespace sdf_ccd {

/// One interval of one shell point on one chord.
struct ShellHit {
  int point;          ///< of the shell
  int chord;          ///< of the path
  Interval interval;  ///< within the chord, [0, 1]
};

/// Points [begin, end) of a shell that are inside along the whole chord.
struct InsidePoints {
  int begin;
  int end;
  int chord;
  int node = -1;  ///< of the tree, whose points these are; −1: of none
};

struct ShellQueryResult {
  std::vector<ShellHit> hits;        ///< by chord, then in the tree's order of points; those of one point by time
  std::vector<InsidePoints> inside;  ///< by chord; of other points than the chord's hits
  long points_tested = 0;            ///< points whose segments were queried

  /// Whether a point is inside at any time.
  bool touches() const { return !hits.empty() || !inside.empty(); }

  /// Intervals of points, chord by chord.
  long count() const;
};

/// Every interval as a hit of its own, by chord.
/// @param hits  replaced; its memory is reused.
void listHits(const ShellQueryResult& result, std::vector<ShellHit>& hits);

/// All intervals in which points of a shell are on or inside the surface φ = 0 while they run along a path.
///
/// Source: Xu & Barbič 2014, §3.3. A node of the sphere tree is skipped if its centre's segment stays farther than
/// radius + the field's error from the surface; all points below a node that stays deeper than that are inside for the
/// whole chord. The result equals that of testing every point. Grids are queried for spheres and points in batches
/// (see segment_query.h for the tolerance, and for the threads of large shells). Reuses the memory of `result`.
/// @param path         X_FP, as chords.
void shellIntervals(const DistanceField& field, const PointShell& shell, const SphereTree& tree, const ChordPath& path,
                    ShellQueryResult& result);

}  // namespace sdf_ccd
