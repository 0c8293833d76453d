#pragma once

#include <optional>

#include "pair_cycle.h"
#include "surface_pair.h"

namespace sdf_ccd {

/// Measures a pair's contact on the surfaces of its bodies: when it begins and ends, and how deep it is. Where a body
/// has no certain solid, the points of shells and fields tell that, and surfaces only what happens between them.
class PairMeasure {
 public:
  /// The bodies must outlive this. @param pair  of them: tells whose shells are used. @param resolution  of depths [m].
  PairMeasure(const Body& a, const Body& b, const PlannedPair& pair, double resolution);

  /// Whether measure() is possible: both bodies have solids.
  bool isExact() const { return depth_.has_value(); }

  /// Sets the intervals of the contact, its deepest point, and its first and last touch; and the verdict CONTACT if the
  /// depth proves it. No intervals if nothing touches.
  /// @param crossing  of the surfaces, or a point of one body inside the other, if one is known.
  /// @param surfaces  must have the motion. @param result  its error.chord bounds the error of the relative position.
  void measure(const PairCycle& cycle, const std::optional<ContactPoint>& crossing, SurfacePair& surfaces,
               PairResult& result);

  /// Adds to what the shells found a known crossing of the surfaces, and the times at which they cross without a point
  /// inside. If the crossing lasts, one body is inside the other all that time.
  /// @param result  must have the contacts of PairForce, with their errors.
  void addCrossing(ContactPoint crossing, SurfacePair& surfaces, SeparationMemory& memory, PairResult& result) const;

  /// Looks for a crossing in intervals without a point.
  void addPeaks(SurfacePair& surfaces, SeparationMemory& memory, PairResult& result) const;

  /// Discards what is known from earlier cycles.
  void forget() {
    if (depth_) depth_->forget();
  }

  /// Upper bound of the depth of any point of one body in the other, at any time of the motion [m].
  /// @param error  of depths and positions [m].
  double greatestDepth(const SurfacePair& surfaces, double error) const;

 private:
  void addDeepestPoints(SurfacePair& surfaces, SeparationMemory& memory, PairResult& result);
  void boundHiddenDepth(ContactPoint& point, PairResult& result) const;

  double greatest_depth_;  // of the two bodies [m]
  double hidden_depth_;    // hiddenDepth() [m]
  std::optional<PairDepth> depth_;
};

}  // namespace sdf_ccd
