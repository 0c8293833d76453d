#pragma once

#include "surface_pair.h"

namespace sdf_ccd {

/// Completes a pair's contact by what its surfaces tell: they may cross between the points of the shells, which then
/// show neither when the contact lasts nor how deep it is.
class SurfaceContacts {
 public:
  /// @param motion_error  see SurfacePair::decide().
  /// @param result        is completed; its contact_error must be set.
  SurfaceContacts(const Scene& scene, const PlannedPair& pair, SurfacePair& surfaces, double motion_error,
                  SeparationMemory& memory, PairResult& result)
      : scene_(scene),
        pair_(pair),
        surfaces_(surfaces),
        motion_error_(motion_error),
        memory_(memory),
        result_(result) {}

  /// Adds a known crossing of the surfaces, and the times at which they cross without a point inside. If the crossing
  /// lasts, one body is inside the other all that time.
  void add(ContactPoint crossing);

  /// Looks for a crossing in intervals without a point, such as those of which only the first touch is known.
  void completePeaks();

 private:
  void boundHiddenDepth(ContactPoint& point) const;

  const Scene& scene_;
  const PlannedPair& pair_;
  SurfacePair& surfaces_;
  const double motion_error_;
  SeparationMemory& memory_;
  PairResult& result_;
};

}  // namespace sdf_ccd
