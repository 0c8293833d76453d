#pragma once

#include <array>
#include <vector>

#include "surface/deepest_point.h"
#include "surface_pair.h"

namespace sdf_ccd {

struct PairCycle;

/// Measures a contact on the triangles of both bodies, starting from what fields and shells found.
class ContactRefinement {
 public:
  /// A motion over one step, of the surface of body p relative to the solid of body f.
  struct StepMotion {
    const Body *f, *p;
    TwoBodyMotion motion;
    double travel;  // of any point of p relative to f, at most [m]
  };

  /// Scratch memory of run().
  struct Memory {
    DeepestSearch search;
    std::vector<StepMotion> motions;                          // those of the search
    std::array<std::vector<RelativeMotionBounds>, 2> bounds;  // per direction
  };

  /// Whether both of two bodies that haveSurfaces() have the solids in which depths are measured, or one is a
  /// half-space.
  static bool isPossible(const Body& a, const Body& b);

  /// The bodies must satisfy isPossible(), and outlive this.
  ContactRefinement(const Body& a, const Body& b, double resolution);

  /// Sets the deepest point and the first touch, and the verdict CONTACT if a depth proves it.
  /// @param result    its error.chord bounds the error of the bodies' relative position.
  /// @param surfaces  must have the motion.
  void run(const PairCycle& cycle, SurfacePair& surfaces, PairResult& result) const;

 private:
  /// The surface of body p, which penetrates the solid of body f.
  struct Direction {
    const Body *f, *p;
    EnteringSurface surface;
    std::vector<SolidPart> solid;
  };

  void setBegin(const Interval& touch, const SurfacePair& surfaces, PairResult& result) const;
  double depthAtSeams(const StepMotion& step, double depth) const;
  void findDeepest(const SweptBodies& bodies, double error, Memory& memory, PairResult& result) const;

  const Body *a_, *b_;
  double resolution_;
  std::vector<Direction> directions_;
};

}  // namespace sdf_ccd
