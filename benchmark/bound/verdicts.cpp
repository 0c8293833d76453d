#include "verdicts.h"

#include <algorithm>
#include <cmath>

#include <fcl/narrowphase/collision.h>

#include "motion/screw_motion.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::benchmark {
namespace {

using namespace precision;

constexpr int kSamples = 33;             ///< sampled poses of a motion
constexpr double kFinestSpacing = 5e-3;  ///< [box sides]; finer shells take minutes
constexpr int kSurfacePoints = 2000;     ///< points that a clearance is compared with, of either kind

Isometry3d moved(const Isometry3d& X, const Vector3d& middle, const Vector3d& travel, double turn, Random& random) {
  Isometry3d step = Isometry3d::Identity();
  step.linear() = Eigen::AngleAxisd(turn, direction(random)).toRotationMatrix();
  step.translation() = middle + travel - step.linear() * middle;
  return step * X;
}

BodyDescription described(const std::string& name, const TriangleMesh& mesh) {
  BodyDescription body;
  body.name = name;
  body.frame = name;
  body.geometry.push_back({std::make_shared<const TriangleMesh>(mesh), Isometry3d::Identity(), name});
  return body;
}

}  // namespace

VerdictStudy::VerdictStudy(const ExactSurface& mesh, int motions)
    : mesh_(mesh), model_(fclModel(mesh.mesh())), side_(boundingBox(mesh.mesh()).sizes().maxCoeff()) {
  Random random(5);
  const SurfaceSampler sampler(mesh.mesh());
  surface_ = mesh.mesh().vertices;
  while (surface_.size() > kSurfacePoints) {
    std::swap(surface_[random() % surface_.size()], surface_.back());
    surface_.pop_back();
  }
  for (int i = 0; i < kSurfacePoints; ++i) surface_.push_back(sampler(random));
  const Vector3d center = boundingBox(mesh.mesh()).center();
  for (int i = 0; i < motions; ++i) {
    Isometry3d start = Isometry3d::Identity();
    start.linear() = rotation(random);
    const auto at = [&](const Vector3d& middle) {
      start.translation() = middle - start.linear() * center;
      return start;
    };
    const Vector3d u = direction(random);
    // Bisects the distance along u at which they touch, starting far away.
    double apart = 2.0 * side_, step = 0.05 * side_;
    while (step > 1e-7 * side_) {
      if (apart > step && !touch(at(center + (apart - step) * u))) {
        apart -= step;
      } else {
        step *= 0.5;
      }
    }
    Isometry3d end;
    const Vector3d aside = u.cross(direction(random)).normalized();
    switch (i % 4) {
      case 0: {  // in a random direction, starting near contact
        const Vector3d middle = center + (apart + uniform(random, -0.01, 0.03) * side_) * u;
        end = moved(at(middle), middle, 0.02 * side_ * direction(random), 0.03, random);
        break;
      }
      case 1: {  // sideways past each other, from a millionth of the side apart on
        const Vector3d middle = center + (apart + side_ * std::pow(10.0, uniform(random, -6.0, -1.5))) * u;
        end = moved(at(middle), middle, 0.02 * side_ * aside, 0.0, random);
        break;
      }
      case 2: {  // a rotation by 1 rad
        const Vector3d middle = center + (apart + uniform(random, 0.0, 0.1) * side_) * u;
        end = moved(at(middle), middle, 0.1 * side_ * aside, 1.0, random);
        break;
      }
      default: {  // starting anywhere, also deep inside
        const Vector3d middle = center + uniform(random, 0.0, 1.2 * apart) * u;
        end = moved(at(middle), middle, 0.05 * side_ * direction(random), 0.1, random);
      }
    }
    ExactMotion motion{start, end, {}};
    const ScrewMotion screw(start, end);
    for (int k = 0; k < kSamples; ++k) motion.touches.push_back(sharesPoint(screw.pose(double(k) / (kSamples - 1))));
    motions_.push_back(std::move(motion));
  }
}

/// Whether the surfaces intersect.
bool VerdictStudy::touch(const Isometry3d& X_WB) const {
  fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  fcl::collide(model_.get(), fcl::Transform3d::Identity(), model_.get(), fcl::Transform3d(X_WB), request, result);
  return result.isCollision();
}

/// Whether the solids intersect, also if one is wholly inside the other.
bool VerdictStudy::sharesPoint(const Isometry3d& X_WB) const {
  const Vector3d& p = mesh_.mesh().vertices[mesh_.mesh().triangles[0][0]];
  return touch(X_WB) || mesh_.surface().inside(X_WB * p) || mesh_.surface().inside(X_WB.inverse() * p);
}

VerdictTally VerdictStudy::run(const FieldOptions& field) const {
  BodyOptions options;
  options.field = field;
  const double error = field.max_error ? *field.max_error : 0.87 * side_ / *field.cells;
  options.shell.spacing = std::max(1.5 * error, kFinestSpacing * side_);
  options.motion_margin = 1e-3 * side_;
  const SceneDescription description{{described("a", mesh_.mesh()), described("b", mesh_.mesh())}, {}};
  MonitorOptions monitor_options;
  monitor_options.chords.tolerance = 1e-4 * side_;
  Monitor monitor(std::make_shared<const Scene>(buildScene(description, planScene(description), options)),
                  monitor_options);
  VerdictTally tally(1e-12 * side_);
  for (const ExactMotion& motion : motions_) {
    monitor.reset();
    CycleMotion cycle;
    cycle.times = {0.0, 1.0};
    cycle.X_WB = {{Isometry3d::Identity(), Isometry3d::Identity()}, {motion.X_WB_start, motion.X_WB_end}};
    compare(motion, monitor.run(cycle, {false, 0}).pairs.front(), tally);
  }
  return tally;
}

void VerdictStudy::compare(const ExactMotion& motion, const PairResult& result, VerdictTally& tally) const {
  tally.largest_bound = std::max(tally.largest_bound, result.error.total());
  const ScrewMotion screw(motion.X_WB_start, motion.X_WB_end);
  const double rounding = 1e-12 * side_;
  if (result.verdict == Verdict::kClear) {
    ++tally.clear;
    tally.verdicts.check(std::none_of(motion.touches.begin(), motion.touches.end(), [](bool touch) { return touch; }));
    double nearest = 2.0 * side_;
    for (const Vector3d& p : surface_) {
      nearest = std::min(nearest, mesh_.unsignedDistance(motion.X_WB_end * p));
      nearest = std::min(nearest, mesh_.unsignedDistance(motion.X_WB_end.inverse() * p));
    }
    tally.clearance.check(result.clearance <= nearest + rounding);
    return;
  }
  if (result.verdict == Verdict::kUncertain) ++tally.uncertain;
  if (result.verdict == Verdict::kContact) {
    ++tally.contact;
    tally.verdicts.check(sharesPoint(screw.pose(result.deepest.time)));
  }
  if (result.intervals.empty()) return;
  // The deepest point lies on one surface and `depth` deep inside the other.
  const Isometry3d X_BW = screw.pose(result.deepest.time).inverse();
  const double in_a = mesh_.distance(result.deepest.p_W), in_b = mesh_.distance(X_BW * result.deepest.p_W);
  const double depth = result.deepest.depth;
  const double error = std::min(std::abs(in_a + depth) + std::abs(in_b), std::abs(in_b + depth) + std::abs(in_a));
  // The chord error displaces the point too.
  tally.depth.add(error, result.deepest.depth_error + result.error.root + 2.0 * result.error.chord);
}

}  // namespace sdf_ccd::benchmark
