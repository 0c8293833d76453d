#include <fcl/narrowphase/continuous_collision.h>

#include "fcl_model.h"
#include "shell_system.h"

namespace sdf_ccd::benchmark {
namespace {

/// FCL's continuous collision of the two meshes by its default solver, which tests 10 poses along the motion and can
/// miss contacts between them. Its conservative advancement is not used: in FCL 0.7.0 it reports no contact for meshes
/// of two balls that collide. FCL rotates the body about one axis, while shell points move on straight lines; it stops
/// at the first contact, and tests surfaces only, so a body inside another is reported as free.
class Fcl : public ShellSystem {
 public:
  explicit Fcl(const ShellSubject& subject)
      : field_(fclModel(subject.field_mesh)), shell_(fclModel(subject.shell_mesh)) {}

  std::string name() const override { return "fcl"; }

  ShellAnswer run(const PosePair* pairs, std::size_t count) override {
    fcl::ContinuousCollisionRequestd request;
    request.ccd_motion_type = fcl::CCDM_LINEAR;
    request.ccd_solver_type = fcl::CCDC_NAIVE;
    const fcl::Transform3d rest = fcl::Transform3d::Identity();
    ShellAnswer answer;
    for (std::size_t i = 0; i < count; ++i) {
      fcl::ContinuousCollisionResultd result;
      fcl::continuousCollide(field_.get(), rest, rest, shell_.get(), pairs[i].X_FP_start, pairs[i].X_FP_end, request,
                             result);
      answer.pairs_in_contact += result.is_collide;
    }
    return answer;
  }

 private:
  std::unique_ptr<FclModel> field_, shell_;
};

const RegisteredShell kFcl{
    [](const ShellSubject& subject, ShellSystems& systems) { systems.push_back(std::make_unique<Fcl>(subject)); }};

}  // namespace
}  // namespace sdf_ccd::benchmark
