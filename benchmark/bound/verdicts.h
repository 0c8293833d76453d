#pragma once

#include <memory>
#include <vector>

#include "bound/tally.h"
#include "fcl_model.h"
#include "precision/exact_surface.h"
#include "precision/random_inputs.h"
#include "sdf_ccd/monitor.h"

/// Verdicts of a monitor for two moving bodies, compared with their exact meshes.
namespace sdf_ccd::benchmark {

/// Motion of a copy of the mesh within a cycle; another copy rests at the origin.
struct ExactMotion {
  Isometry3d X_WB_start, X_WB_end;
  std::vector<bool> touches;  ///< per sampled pose, both ends included: whether the solids intersect
};

/// Results of the comparison.
struct VerdictTally {
  explicit VerdictTally(double rounding) : depth(rounding) {}

  BoundTally verdicts;   ///< CLEAR and CONTACT against the meshes
  BoundTally clearance;  ///< reported clearance against the meshes' distance
  BoundTally depth;      ///< depth of the deepest point against the meshes, at its location and time
  long clear = 0, contact = 0, uncertain = 0;
  double largest_bound = 0.0;  ///< largest error bound of the verdicts [m]
};

class VerdictStudy {
 public:
  VerdictStudy(const precision::ExactSurface& mesh, int motions);

  /// Checks all motions with the monitor, with fields of these options.
  VerdictTally run(const FieldOptions& field) const;

 private:
  bool touch(const Isometry3d& X_WB) const;
  bool sharesPoint(const Isometry3d& X_WB) const;
  void compare(const ExactMotion& motion, const PairResult& result, VerdictTally& tally) const;

  const precision::ExactSurface& mesh_;
  std::unique_ptr<FclModel> model_;
  double side_;
  std::vector<Vector3d> surface_;  ///< points on it
  std::vector<ExactMotion> motions_;
};

}  // namespace sdf_ccd::benchmark
