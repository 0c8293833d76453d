#pragma once

#include <array>
#include <vector>

#include "surface/deepest_point.h"
#include "surface_pair.h"

namespace sdf_ccd {

/// Measures a contact on the triangles of both bodies, starting from what fields and shells found.
class ContactRefinement {
 public:
  /// A motion over one step, of a surface relative to the solid of body f.
  struct StepMotion {
    int f, p;
    TwoBodyMotion motion;
    double travel;  // of any point of p relative to f, at most [m]
  };

  /// Scratch memory of run().
  struct Memory {
    DeepestSearch search;
    std::vector<StepMotion> motions;                          // those of the search
    std::array<std::vector<RelativeMotionBounds>, 2> bounds;  // per direction
    SeparationMemory separation;
  };

  /// Whether both bodies of a pair that haveSurfaces() have the solids in which depths are measured, or one is a
  /// half-space.
  static bool isPossible(const Scene& scene, const PlannedPair& pair);

  /// The pair must satisfy isPossible().
  ContactRefinement(const Scene& scene, const PlannedPair& pair, double resolution);

  /// Sets the deepest point and the first touch, and the verdict CONTACT if a depth proves it.
  /// @param surfaces      must have the motion.
  /// @param motion_error  upper bound of the error of the bodies' relative position [m].
  void run(const SweptBodies& bodies, SurfacePair& surfaces, double motion_error, Memory& memory,
           PairResult& result) const;

 private:
  /// The surface of body p, which penetrates the solid of body f.
  struct Direction {
    int f, p;
    EnteringSurface surface;
    std::vector<SolidPart> solid;
  };

  void setBegin(const Interval& touch, const SurfacePair& surfaces, PairResult& result) const;
  double depthAtSeams(const StepMotion& step, double depth) const;
  void findDeepest(const SweptBodies& bodies, double error, Memory& memory, PairResult& result) const;

  const Scene& scene_;
  double resolution_;
  std::vector<Direction> directions_;
};

}  // namespace sdf_ccd
