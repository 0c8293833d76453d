#include "impact_study.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <fcl/narrowphase/distance.h>

#include "common/number_text.h"
#include "fcl_model.h"
#include "impact_systems.h"
#include "motion/screw_motion.h"
#include "precision/random_inputs.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd::benchmark {
namespace {

using namespace precision;

constexpr double kTolerance = 1e-7;  // of the exact impact [m]
constexpr int kMaxSteps = 1000;      // of conservative advancement

/// A motion of a body that meets one at rest, with the exact time of impact.
struct ExactImpact {
  Isometry3d X_FP_start, X_FP_end;
  double time;    ///< in (0, 1)
  double travel;  ///< upper bound of the travel of all points [m]
};

/// Two copies of a mesh: one rests at the origin, the other moves.
class Copies {
 public:
  explicit Copies(const TriangleMesh& mesh) : model_(fclModel(mesh)) {
    const AlignedBox3d box = boundingBox(mesh);
    side_ = box.sizes().maxCoeff();
    ball_.center = box.center();
    for (const Vector3d& v : mesh.vertices) ball_.radius = std::max(ball_.radius, (v - ball_.center).norm());
  }

  /// Parts of random motions that turn by 0.3 to 1.5 rad: from 0.01 to 0.05 of the side before the impact to 0.02
  /// after.
  std::vector<ExactImpact> impacts(int count) const {
    Random random(7);
    std::vector<ExactImpact> found;
    for (int tries = 0; int(found.size()) < count; ++tries) {
      if (tries > 50 * count) throw std::runtime_error("copies of the body do not touch when they rotate");
      const Matrix3d R = rotation(random);
      const Vector3d u = direction(random);
      const double apart = touchingDistance(R, u) + uniform(random, 0.02, 0.1) * side_;
      const Matrix3d turned = Eigen::AngleAxisd(uniform(random, 0.3, 1.5), direction(random)).toRotationMatrix() * R;
      const Isometry3d start = placed(R, apart * u), end = placed(turned, (apart - 0.15 * side_) * u);
      const ScrewMotion screw(start, end);
      const double travel = screw.maxTravel(ball_);
      const double time = impactTime(screw, travel);
      if (!(time > 0.0 && time < 1.0)) continue;
      // A cycle's part of the motion.
      const double from = std::max(0.0, time - uniform(random, 0.01, 0.05) * side_ / travel),
                   until = std::min(1.0, time + 0.02 * side_ / travel);
      found.push_back({screw.pose(from), screw.pose(until), (time - from) / (until - from), travel * (until - from)});
    }
    return found;
  }

 private:
  Isometry3d placed(const Matrix3d& R, const Vector3d& offset) const {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = R;
    X.translation() = ball_.center + offset - R * ball_.center;
    return X;
  }

  /// Distance of the surfaces; zero or less where they intersect.
  double distance(const Isometry3d& X_FP) const {
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    return fcl::distance(model_.get(), fcl::Transform3d::Identity(), model_.get(), fcl::Transform3d(X_FP), request,
                         result);
  }

  /// Distance along u at which a copy that comes from far away first touches.
  double touchingDistance(const Matrix3d& R, const Vector3d& u) const {
    double apart = 2.0 * ball_.radius;
    for (int step = 0; step < kMaxSteps; ++step) {
      const double d = distance(placed(R, apart * u));
      if (d <= 1e-3 * side_) break;
      apart -= d;
    }
    return apart;
  }

  /// By conservative advancement: a screw's points have constant speeds, of at most `travel`. 1 if it does not touch,
  /// or so slowly that it takes too many steps.
  double impactTime(const ScrewMotion& screw, double travel) const {
    double t = 0.0;
    for (int step = 0; step < kMaxSteps && t < 1.0; ++step) {
      const double d = distance(screw.pose(t));
      if (d <= kTolerance) return t;
      t += d / travel;
    }
    return 1.0;
  }

  std::unique_ptr<FclModel> model_;
  double side_ = 0.0;
  BoundingBall ball_{Vector3d::Zero(), 0.0};
};

/// The begin of a contact, as a cycle of a monitor reports it.
class CycleSystem {
 public:
  CycleSystem(const TriangleMesh& mesh, const BodyOptions& bodies, const MonitorOptions& options) {
    SceneDescription description;
    const auto shared = std::make_shared<const TriangleMesh>(mesh);
    for (const char* name : {"a", "b"}) {
      BodyDescription& body = description.bodies.emplace_back();
      body.name = body.frame = name;
      body.geometry.push_back({shared, Isometry3d::Identity(), name});
    }
    monitor_ = std::make_unique<Monitor>(
        std::make_shared<const Scene>(buildScene(description, planScene(description, planOptions(bodies)), bodies)),
        options);
    request_.wrenches = false;
    motion_.times = {0.0, 1.0};
    motion_.X_WB.assign(2, {Isometry3d::Identity(), Isometry3d::Identity()});
  }

  double operator()(const Isometry3d& X_FP_start, const Isometry3d& X_FP_end) {
    monitor_->reset();
    motion_.X_WB[1] = {X_FP_start, X_FP_end};
    const PairResult& pair = monitor_->run(motion_, request_).pairs.front();
    return pair.intervals.empty() ? -1.0 : pair.intervals.front().enter;
  }

 private:
  std::unique_ptr<Monitor> monitor_;
  CycleRequest request_;
  CycleMotion motion_;
};

std::vector<ImpactSystem> cycleSystems(const TriangleMesh& mesh) {
  std::vector<ImpactSystem> systems;
  const auto add = [&](const char* name, double value, const BodyOptions& bodies, const MonitorOptions& options) {
    const auto system = std::make_shared<CycleSystem>(mesh, bodies, options);
    ImpactSystem& added = systems.emplace_back();
    added.label.system = name;
    added.label.setting = lengthText(value);
    added.label.value = value;
    added.impact = [system](const Isometry3d& start, const Isometry3d& end) { return (*system)(start, end); };
  };
  for (const double max_error : {1e-2, 1e-3, 1e-4, kMinMaxError}) {
    MonitorOptions options;
    options.max_error = max_error;
    add("sdf_ccd monitor (max_error)", max_error, optionsForContacts(), options);
  }
  return systems;
}

}  // namespace

StudyResult impactStudy(const StudyInput& input) {
  StudyResult result{"impact", "Two bodies: time of impact", "max_error or accuracy [m]", "motion of a body", {}};
  const std::vector<ExactImpact> exact = Copies(input.mesh).impacts(std::max(10, input.queries / 40));
  std::vector<ImpactSystem> systems = cycleSystems(input.mesh);
  for (const ImpactFactory& factory : impactFactories())
    for (ImpactSystem& peer : factory(input.mesh, input.mesh)) systems.push_back(std::move(peer));
  std::vector<System<double>> timed;
  for (const ImpactSystem& system : systems)
    timed.push_back({system.label, [&exact, impact = system.impact](std::vector<double>& times) {
                       for (std::size_t i = 0; i < exact.size(); ++i)
                         times[i] = impact(exact[i].X_FP_start, exact[i].X_FP_end);
                     }});
  const auto error = [&](std::size_t i, double time) {
    return time < 0.0 ? Label::kNone : std::abs(time - exact[i].time) * exact[i].travel;
  };
  result.rows =
      measure<double>(timed, exact.size(), {{"time of impact (length of travel)", "m", error}}, input.progress);
  return result;
}

}  // namespace sdf_ccd::benchmark
