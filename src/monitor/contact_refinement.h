#pragma once

#include <array>
#include <vector>

#include "query/deepest_point.h"
#include "surface_pair.h"

namespace sdf_ccd {

/// Measures a contact of two bodies on their triangles: what fields and shells found is the place to begin with.
class ContactRefinement {
 public:
  /// What it needs while it runs.
  struct Memory {
    DeepestSearch search;
    std::array<std::vector<RelativeMotionBounds>, 2> bounds;  // per direction
    SeparationMemory separation;
  };

  /// Whether a pair that hasTriangles() has what depths are measured on.
  static bool isPossible(const Scene& scene, const PlannedPair& pair);

  /// Of a pair for which it isPossible().
  ContactRefinement(const Scene& scene, const PlannedPair& pair, double resolution);

  /// Writes the deepest point and the first touch, and CONTACT where a depth proves it.
  /// @param surfaces      have taken the motion.
  /// @param motion_error  the bodies are no farther than this from where the motion has them, both together [m].
  void run(const SweptBodies& bodies, SurfacePair& surfaces, double motion_error, Memory& memory,
           PairResult& result) const;

 private:
  /// One body's surface in the other body.
  struct Direction {
    int f, p;  // the solid's body, the surface's
    EnteringSurface surface;
    std::vector<SolidPart> solid;
  };

  void setBegin(const Interval& touch, const SurfacePair& surfaces, PairResult& result) const;
  void findDeepest(const SweptBodies& bodies, double error, Memory& memory, PairResult& result) const;

  const Scene& scene_;
  double resolution_;
  std::vector<Direction> directions_;
};

}  // namespace sdf_ccd
