#include <fcl/narrowphase/continuous_collision.h>

#include "fcl_model.h"
#include "impact_systems.h"

namespace sdf_ccd::benchmark {
namespace {

/// FCL's continuous collision along a screw motion by its default solver, which tests a given number of poses.
std::vector<ImpactSystem> impacts(const TriangleMesh& field, const TriangleMesh& shell) {
  const std::shared_ptr<const FclModel> field_model = fclModel(field), shell_model = fclModel(shell);
  std::vector<ImpactSystem> systems;
  for (const int poses : {10, 100, 1000}) {
    const auto impact = [=](const Isometry3d& X_FP_start, const Isometry3d& X_FP_end) {
      fcl::ContinuousCollisionRequestd request;
      request.ccd_motion_type = fcl::CCDM_SCREW;
      request.ccd_solver_type = fcl::CCDC_NAIVE;
      request.num_max_iterations = std::size_t(poses);
      fcl::ContinuousCollisionResultd result;
      const fcl::Transform3d rest = fcl::Transform3d::Identity();
      fcl::continuousCollide(field_model.get(), rest, rest, shell_model.get(), X_FP_start, X_FP_end, request, result);
      return result.is_collide ? result.time_of_contact : -1.0;
    };
    const precision::Label label{"fcl", std::to_string(poses) + " poses", double(poses)};
    systems.push_back({label, impact});
  }
  return systems;
}

const RegisteredImpact kFcl{&impacts};

}  // namespace
}  // namespace sdf_ccd::benchmark
