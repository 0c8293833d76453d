#pragma once

#include <optional>

#include "pair_cycle.h"
#include "surface_pair.h"

namespace sdf_ccd {

/// Measures a pair's contact on the surfaces of its bodies: they may cross between the points of the shells, which then
/// show neither when the contact lasts nor how deep it is.
class PairMeasure {
 public:
  /// The bodies must outlive this. @param pair  of them: tells whose shells are used. @param resolution  of depths [m].
  PairMeasure(const Body& a, const Body& b, const PlannedPair& pair, double resolution);

  /// Adds a known crossing of the surfaces, and the times at which they cross without a point inside. If the crossing
  /// lasts, one body is inside the other all that time.
  /// @param surfaces  must have the motion. @param result  must have the contacts of PairForce, with their errors.
  void addCrossing(ContactPoint crossing, SurfacePair& surfaces, SeparationMemory& memory, PairResult& result) const;

  /// Measures the greatest depth and the first touch, if the request wants it and the bodies allow it. Looks for a
  /// crossing in intervals without a point, such as those of which only the first touch is known.
  void complete(const PairCycle& cycle, SurfacePair& surfaces, PairResult& result) const;

  /// Upper bound of the depth of any point of one body in the other, at any time of the motion [m].
  /// @param error  of depths and positions [m].
  double greatestDepth(const SurfacePair& surfaces, double error) const;

 private:
  void boundHiddenDepth(ContactPoint& point, PairResult& result) const;

  double greatest_depth_;  // of the two bodies [m]
  double hidden_depth_;    // hiddenDepth() [m]
  std::optional<ContactRefinement> refinement_;
};

}  // namespace sdf_ccd
