/// The study `chord`: time of impact of rotating bodies.

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "common/number_text.h"
#include "contact_query.h"
#include "exact_surface.h"
#include "impact_measurement.h"
#include "motion/time_at.h"
#include "sdf_ccd/field/build_field.h"
#include "studies.h"

namespace sdf_ccd::precision {
namespace {

constexpr int kChordCells = 128;
constexpr double kChordSpacing = 0.015;  // of the shell's points [box sides]

/// Time of impact in [0, 1] of the shell's points, on their arcs, with the mesh; 2 if there is none. By conservative
/// advancement: a point's speed is constant, as the twist is, so no step moves it farther than its distance to the
/// surface. All points must start outside.
double exactImpact(const ExactSurface& mesh, const PointShell& shell, const ScrewMotion& motion, double tolerance) {
  double first = 2.0;
  for (const Vector3d& p : shell.points()) {
    const double speed = motion.velocity(0.0, p).norm();
    for (double t = 0.0; t < std::min(first, 1.0);) {
      const double distance = mesh.unsignedDistance(motion.pose(t) * p);
      if (distance <= tolerance) {
        first = t;
        break;
      }
      t += std::max(distance, tolerance) / speed;
    }
  }
  return first;
}

/// Random motions of copies of the body that rotate into it by 0.3 to 1.5 rad, starting 0.02 to 0.1 of the side apart.
std::vector<ExactImpact> motions(const ExactSurface& mesh, const DistanceField& field, const TreeShell& shell,
                                 const BoundingBall& ball, int count) {
  const double side = field.surfaceBox().sizes().maxCoeff();
  const Vector3d middle = field.surfaceBox().center();
  Random random(4);
  std::vector<ExactImpact> found;
  for (int tries = 0; int(found.size()) < count; ++tries) {
    if (tries > 50 * count) throw std::runtime_error("copies of the body do not touch when they rotate");
    const Matrix3d R = rotation(random);
    const Vector3d u = direction(random);
    const double apart = touchingDistance(field, shell, R, u, side) + uniform(random, 0.02, 0.1) * side;
    const Matrix3d rotated = Eigen::AngleAxisd(uniform(random, 0.3, 1.5), direction(random)).toRotationMatrix() * R;
    Motion motion{Isometry3d::Identity(), Isometry3d::Identity()};
    motion.X_FP_start.linear() = R;
    motion.X_FP_start.translation() = middle + apart * u - R * middle;
    motion.X_FP_end.linear() = rotated;
    motion.X_FP_end.translation() = middle + (apart - 0.15 * side) * u - rotated * middle;
    const ScrewMotion screw(motion.X_FP_start, motion.X_FP_end);
    const double impact = exactImpact(mesh, shell.shell, screw, 1e-7 * side);
    if (impact > 0.0 && impact < 1.0) found.push_back({motion, impact, screw.maxTravel(ball)});
  }
  return found;
}

/// Time of impact as a check of a pair of bodies finds it: cuts the motion into chords, returns the earliest hit.
class ChordSystem {
 public:
  ChordSystem(const DistanceField& field, const TreeShell& shell, const BoundingBall& ball, double tolerance)
      : field_(field), shell_(shell), ball_(ball) {
    options_.tolerance = tolerance;
  }

  double operator()(const Motion& motion) {
    cutIntoChords({{0.0, 1.0}, {motion.X_FP_start, motion.X_FP_end}}, ball_, options_, path_);
    shellIntervals(field_, shell_.shell, shell_.tree, path_, {}, result_);
    double first = -1.0;
    const auto offer = [&](int chord_index, double s) {
      const Chord& chord = path_.chords[chord_index];
      const double t = timeAt(chord, s);
      if (first < 0.0 || t < first) first = t;
    };
    for (const ShellHit& hit : result_.hits) offer(hit.chord, hit.interval.enter);
    for (const InsidePoints& points : result_.inside) offer(points.chord, 0.0);
    return first;
  }

 private:
  const DistanceField& field_;
  const TreeShell& shell_;
  BoundingBall ball_;
  ChordOptions options_;
  ChordPath path_;
  ShellQueryResult result_;
};

BoundingBall ballOf(const PointShell& shell, const Vector3d& middle) {
  BoundingBall ball{middle, 0.0};
  for (const Vector3d& p : shell.points()) ball.radius = std::max(ball.radius, (p - middle).norm());
  return ball;
}

}  // namespace

StudyResult chordStudy(const StudyInput& input) {
  StudyResult result{"chord",
                     "Rotating bodies: time of impact over the chord tolerance",
                     "chord tolerance [m]",
                     "motion of a body",
                     {}};
  FieldOptions options;
  options.cells = kChordCells;
  const DistanceField field = buildField(input.mesh, options, [&](double share) { input.progress(0.3 * share); });
  const double side = field.surfaceBox().sizes().maxCoeff();
  const TreeShell shell(input.mesh, kChordSpacing * side);
  const BoundingBall ball = ballOf(shell.shell, field.surfaceBox().center());
  const ExactSurface mesh(input.mesh);
  const std::vector<ExactImpact> exact = motions(mesh, field, shell, ball, std::max(10, input.queries / 40));
  input.progress(0.6);

  std::vector<ImpactSystem> systems;
  for (const double share : {3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5}) {
    auto system = std::make_shared<ChordSystem>(field, shell, ball, share * side);
    const Label label{"sdf_ccd (chords)", lengthText(share * side), share * side};
    systems.push_back({label, [system](const Isometry3d& start, const Isometry3d& end) {
                         return (*system)({start, end});
                       }});
  }
  if (input.peers.impacts) {
    for (ImpactSystem& peer : input.peers.impacts(input.mesh, input.mesh)) systems.push_back(std::move(peer));
  }
  result.rows = measureImpacts(systems, exact, [&](double share) { input.progress(0.6 + 0.4 * share); });
  return result;
}

}  // namespace sdf_ccd::precision
