#include <cmath>

#include "adversarial/chains.h"
#include "adversarial/duel.h"
#include "oracle/shapes.h"

/// The family `both_move`: two bodies that each follow their own constant twist in the world, as dual arms, spinning
/// and fast approaching bodies do.
namespace sdf_ccd::test {
namespace {

constexpr double kLargestAngle = 3.0;  // [rad]; two poses do not determine rotations above π
constexpr int kShifts = 4;             // cases per aimed motion

TriangleMesh tetrahedron(double size) {
  return {{{size, size, size}, {-size, -size, size}, {-size, size, -size}, {size, -size, -size}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

std::vector<Duel> duels() {
  const Vector3d arm(0.4, 0.02, 0.02), reach(0.4, 0.0, 0.0);
  BodyOptions coarse;
  coarse.field.max_error = 2e-3;
  coarse.shell.spacing = 0.04;
  coarse.shell.edge_gap = 4e-3;
  BodyOptions fine;
  fine.field.max_error = 5e-4;
  fine.shell.spacing = 0.03;
  fine.shell.edge_gap = 2e-3;
  MonitorOptions options;
  options.chords.tolerance = 2e-4;
  std::vector<Duel> all;
  all.emplace_back(boxActor(arm, reach), boxActor(arm, reach), coarse, options);
  all.emplace_back(convexActor("arm", boxMesh(arm), reach), boxActor(arm, reach), coarse, options);
  all.emplace_back(convexActor("tetrahedron", tetrahedron(0.1)), boxActor({0.1, 0.06, 0.03}), fine, options);
  all.emplace_back(boxActor({0.15, 0.1, 0.002}), boxActor({0.02, 0.02, 0.15}), fine, options);
  all.emplace_back(ballActor(0.05), boxActor(arm, reach), coarse, options);
  all.emplace_back(ballActor(0.2), boxActor({0.05, 0.04, 0.03}), coarse, options);
  all.emplace_back(ballActor(0.2), ballActor(0.15), coarse, options);
  options.chords = {1e-6, 3};  // too few chords for the tolerance: the remaining error counts
  all.emplace_back(boxActor(arm, reach), convexActor("tetrahedron", tetrahedron(0.1)), coarse, options);
  return all;
}

/// A screw motion of a body.
struct Move {
  Vector3d point, rotation, shift;

  Isometry3d operator()(const Isometry3d& X) const { return screwed(X, point, rotation, shift); }
};

Isometry3d anyPose(Random& random) {
  return pose(random, 3.0, 0.3);
}

/// Initial poses of both bodies, and one step of each.
struct Start {
  Isometry3d X_WA, X_WB;
  Move a, b;
};

Start randomStart(Random& random, double size) {
  Start start{anyPose(random), anyPose(random), {}, {}};
  const auto angle = [&] { return logUniform(random, 0.01, kLargestAngle); };
  const Vector3d axis = direction(random);
  const double a = angle(), b = angle();
  start.a = {start.X_WA.translation(), a * direction(random), Vector3d::Zero()};
  start.b = {start.X_WB.translation(), b * direction(random), Vector3d::Zero()};
  switch (random() % 6) {
    case 0:  // two arms about different axes
      break;
    case 1:  // about parallel axes, in opposite directions
      start.a.rotation = a * axis;
      start.b.rotation = -b * axis;
      break;
    case 2:  // about a common axis in opposite directions, relatively up to six radians
      start.a = {Vector3d::Zero(), a * axis, Vector3d::Zero()};
      start.b = {Vector3d::Zero(), -b * axis, Vector3d::Zero()};
      break;
    case 3:  // approaching bodies that spin fast
      start.a.rotation = uniform(random, 2.0, kLargestAngle) * direction(random);
      start.b.rotation = uniform(random, 2.0, kLargestAngle) * direction(random);
      start.a.shift = size * direction(random);
      start.b.shift = -start.a.shift;
      break;
    case 4:  // carried by a common base, with a small relative motion
      start.a = {size * direction(random), a * axis, 0.1 * size * direction(random)};
      start.b = {start.a.point, a * axis + 0.1 * direction(random), start.a.shift};
      break;
    default:  // any screws
      start.a = {size * direction(random), a * direction(random), uniform(random, 0.0, size) * direction(random)};
      start.b = {size * direction(random), b * direction(random), uniform(random, 0.0, size) * direction(random)};
  }
  return start;
}

CycleMotion randomMotion(Random& random, double size) {
  const Start start = randomStart(random, size);
  std::vector<Isometry3d> X_WA{start.X_WA}, X_WB{start.X_WB};
  Move a = start.a, b = start.b;
  for (int steps = 1 + int(random() % 4) / 3; steps > 0; --steps) {
    X_WA.push_back(a(X_WA.back()));
    X_WB.push_back(b(X_WB.back()));
    a.rotation *= -0.5;
    b.shift *= -1.0;
  }
  return pairCycle(std::move(X_WA), std::move(X_WB));
}

/// Plays motions with constant twists between given poses.
void playScrews(Duel& duel, Random& random, Tally& tally) {
  CycleMotion motion = randomMotion(random, duel.size());
  const Vector3d axis = duel.aim(0.0, motion);
  for (int i = 0; i < kShifts; ++i) {
    CycleMotion shifted = motion;
    // Sometimes shifted so little that the contact lies between the points of a shell.
    const double few = random() % 4 == 0 ? 0.02 : 1.0;
    shiftB(few * uniform(random, -3.0, 3.0) * duel.bound() * axis, shifted);
    duel.play(shifted, tally);
    if (tally.cases % 16 != 0) continue;
    ++tally.placed;
    const LeastOptions options{0.1L * duel.bound(), 4 * duel.bound(), -4 * duel.bound(), 2000};
    const LeastValue least = duel.least(shifted, {0, shifted.times.size() - 1}, options);
    tally.near += std::abs(least.high) < 3.0 * duel.bound();
  }
}

/// Plays motions of joint chains.
void playChains(Duel& duel, Random& random, Tally& tally) {
  ChainPair pair(random);
  const Vector3d axis = duel.aim(
      0.0, [&] { return pair.truth(duel); }, [&](const Vector3d& by) { pair.shiftB(by); });
  for (int i = 0; i < kShifts; ++i) {
    ChainPair shifted = pair;
    shifted.shiftB(uniform(random, -3.0, 3.0) * duel.bound() * axis);
    shifted.play(duel, tally);
  }
}

}  // namespace

Tally bothMove(std::uint64_t seed, long cases) {
  Random random(seed);
  std::vector<Duel> all = duels();
  Tally tally;
  while (tally.cases < cases) {
    Duel& duel = all[random() % all.size()];
    if (random() % 4 == 0) {
      playChains(duel, random, tally);
    } else {
      playScrews(duel, random, tally);
    }
  }
  return tally;
}

}  // namespace sdf_ccd::test
