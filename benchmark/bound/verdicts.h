#pragma once

#include <memory>
#include <vector>

#include "bound/tally.h"
#include "fcl_model.h"
#include "precision/exact_surface.h"
#include "precision/random_inputs.h"
#include "sdf_ccd/monitor/monitor.h"

/// What a monitor says of two bodies that move, against what their meshes do.
namespace sdf_ccd::benchmark {

/// A copy of the mesh that moves about one that rests at the origin, as within a cycle.
struct ExactMotion {
  Isometry3d X_WB_start, X_WB_end;
  std::vector<bool> touches;  ///< per sample of the motion, both ends included: the solids share a place
};

/// How the monitor's answers fared.
struct VerdictTally {
  explicit VerdictTally(double rounding) : depth(rounding) {}

  BoundTally verdicts;   ///< CLEAR or CONTACT that the meshes contradict
  BoundTally clearance;  ///< a clearance that the meshes' distance falls below
  BoundTally depth;      ///< depth of the deepest point against the mesh at its place and time
  long clear = 0, contact = 0, uncertain = 0;
  double largest_bound = 0.0;  ///< of the verdicts [m]
};

class VerdictStudy {
 public:
  VerdictStudy(const precision::ExactSurface& mesh, int motions);

  /// Runs the monitor over all motions, with fields of these options.
  VerdictTally run(const FieldOptions& field) const;

 private:
  bool touch(const Isometry3d& X_WB) const;
  bool sharesPlace(const Isometry3d& X_WB) const;
  void compare(const ExactMotion& motion, const PairResult& result, VerdictTally& tally) const;

  const precision::ExactSurface& mesh_;
  std::unique_ptr<FclModel> model_;
  double side_;
  std::vector<Vector3d> surface_;  ///< places on it
  std::vector<ExactMotion> motions_;
};

}  // namespace sdf_ccd::benchmark
