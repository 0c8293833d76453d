#include <cmath>
#include <limits>

#include "adversarial/duel.h"
#include "oracle/integer_sweep.h"
#include "oracle/shapes.h"

/// The family `degenerate`: coplanar slides, parallel edges, corner on corner, touch at a single instant, after the
/// scenes of Erleben (2018) and the benchmark of Wang et al. (2021, Tight-Inclusion). All coordinates are multiples of
/// a step, so the truth is computed exactly.
namespace sdf_ccd::test {
namespace {

constexpr double kStep = 0x1.0p-16;  // [m]
constexpr int kLattice = 1 << 10;    // steps per lattice cell
constexpr double kCell = kStep * kLattice;

/// An actor made of convex parts with integer coordinates.
struct WholeActor {
  Actor actor;
  std::vector<TriangleMesh> parts;
};

TriangleMesh blockMesh(const Vector3i& low, const Vector3i& high) {
  const Vector3d a = kCell * low.cast<double>(), b = kCell * high.cast<double>();
  return translated(boxMesh(0.5 * (b - a)), 0.5 * (a + b));
}

/// A pyramid with a square base and its apex on the z axis.
TriangleMesh spike(int half_width, int height) {
  const double w = kCell * half_width, h = kCell * height;
  return {{{-w, -w, 0}, {w, -w, 0}, {w, w, 0}, {-w, w, 0}, {0, 0, h}},
          {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

TriangleMesh wedge(int half_width, int half_length, int height) {
  const double w = kCell * half_width, l = kCell * half_length, h = kCell * height;
  return {{{-w, -l, 0}, {w, -l, 0}, {w, l, 0}, {-w, l, 0}, {0, -l, h}, {0, l, h}},
          {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {2, 3, 5}, {1, 2, 5}, {1, 5, 4}, {3, 0, 4}, {3, 4, 5}}};
}

WholeActor wholeActor(const std::string& kind, std::vector<TriangleMesh> parts) {
  WholeActor whole{{kind, {}, {}, {}, parts.size() == 1}, std::move(parts)};
  for (const TriangleMesh& part : whole.parts) {
    whole.actor.geometry.push_back({std::make_shared<const TriangleMesh>(part), Isometry3d::Identity(), kind});
    whole.actor.solid.push_back(convexOf(part));
  }
  return whole;
}

/// A block as a primitive, with an exact field.
WholeActor exactBlock(const Vector3i& half) {
  const Vector3d half_size = kCell * half.cast<double>();
  return {boxActor(half_size), {boxMesh(half_size)}};
}

std::vector<WholeActor> sharpActors() {
  return {exactBlock({4, 4, 4}), wholeActor("spike", {spike(2, 6)}), wholeActor("wedge", {wedge(2, 4, 6)}),
          wholeActor("block", {blockMesh({-4, -2, -1}, {4, 2, 1})})};
}

std::vector<WholeActor> groundActors() {
  const TriangleMesh left = blockMesh({-8, -6, -3}, {0, 6, 0}), right = blockMesh({0, -6, -3}, {8, 6, 0});
  return {exactBlock({8, 6, 3}),
          wholeActor("wedge", {wedge(3, 6, 5)}),
          wholeActor("internal edges", {left, right}),
          wholeActor("cliff", {left, blockMesh({0, -6, -3}, {8, 6, 4})}),
          wholeActor("crack", {blockMesh({-8, -6, -3}, {-1, 6, 0}), blockMesh({1, -6, -3}, {8, 6, 0})}),
          wholeActor("hole", {blockMesh({-8, -6, -3}, {-2, 6, 0}), blockMesh({2, -6, -3}, {8, 6, 0}),
                              blockMesh({-2, -6, -3}, {2, -2, 0}), blockMesh({-2, 2, -3}, {2, 6, 0})})};
}

std::vector<WholeConvex> wholeParts(const WholeActor& actor) {
  std::vector<WholeConvex> parts;
  for (const TriangleMesh& part : actor.parts) parts.push_back(wholeConvexOf(part, kStep));
  return parts;
}

/// A duel with the integer coordinates of its bodies.
struct WholeDuel {
  std::vector<WholeConvex> a, b;
  Duel duel;
};

std::vector<WholeDuel> duels() {
  BodyOptions scene;
  scene.field.max_error = 1e-3;
  scene.shell.spacing = 0.02;
  scene.shell.edge_gap = 2e-3;
  scene.motion_margin = 1e-4;
  MonitorOptions monitor;
  monitor.chords.tolerance = 1e-5;
  std::vector<WholeDuel> all;
  for (const WholeActor& ground : groundActors())
    for (const WholeActor& sharp : sharpActors())
      all.push_back({wholeParts(ground), wholeParts(sharp), Duel(ground.actor, sharp.actor, scene, monitor)});
  return all;
}

/// One of the 24 rotations of a cube.
Matrix3d cubeRotation(Random& random) {
  const int first = int(random() % 3), second = (first + 1 + int(random() % 2)) % 3;
  Matrix3d R = Matrix3d::Zero();
  R(first, 0) = random() % 2 ? 1.0 : -1.0;
  R(second, 1) = random() % 2 ? 1.0 : -1.0;
  R.col(2) = R.col(0).cross(R.col(1));
  return R;
}

Isometry3d cubePose(Random& random) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = cubeRotation(random);
  return X;
}

Vector3w steps(const Vector3d& v) {
  return {Whole(v.x() / kStep), Whole(v.y() / kStep), Whole(v.z() / kStep)};
}

std::vector<WholeConvex> moved(const std::vector<WholeConvex>& parts, const Isometry3d& X) {
  const Eigen::Matrix<Whole, 3, 3> R = X.linear().cast<int>().cast<Whole>();
  std::vector<WholeConvex> result;
  for (const WholeConvex& part : parts) result.push_back(moved(part, R, steps(X.translation())));
  return result;
}

/// The exact result over all pairs of parts.
Sweep truth(const WholeDuel& whole, const CycleMotion& motion) {
  const Isometry3d &X_WA = motion.X_WB[0][0], &X_WB = motion.X_WB[1][0];
  const Vector3w path = steps((motion.X_WB[1][1].translation() - X_WB.translation()) -
                              (motion.X_WB[0][1].translation() - X_WA.translation()));
  const std::vector<WholeConvex> a = moved(whole.a, X_WA), b = moved(whole.b, X_WB);
  Sweep found = Sweep::kApart;
  for (const WholeConvex& part_a : a) {
    for (const WholeConvex& part_b : b) {
      const Sweep here = sweep(part_a, part_b, path);
      if (here == Sweep::kOverlap) return here;
      if (here == Sweep::kTouch) found = here;
    }
  }
  return found;
}

Vector3d latticePoint(Random& random, int reach) {
  Vector3d p;
  for (int k = 0; k < 3; ++k) p[k] = kCell * (int(random() % (2 * reach + 1)) - reach);
  return p;
}

/// Translations of both bodies between lattice points, some of them offset by one step or by the error bound.
CycleMotion slide(Random& random, double bound) {
  Isometry3d X_WA = cubePose(random), X_WB = cubePose(random);
  X_WA.translation() = latticePoint(random, 4);
  X_WB.translation() = X_WA.translation() + latticePoint(random, 12);
  Vector3d a = latticePoint(random, 4), b = a + latticePoint(random, 12);
  const int zeros = int(random() % 4);  // the relative path is along an axis, in a plane, or arbitrary
  for (int k = 0; k < zeros && k < 2; ++k) b[(k + int(zeros == 3)) % 3] = a[(k + int(zeros == 3)) % 3];
  const double far = kStep * std::ceil(bound / kStep);
  const double beside[] = {0.0, 0.0, kStep, -kStep, far, -far, 2.0 * far};
  X_WB.translation()[int(random() % 3)] += beside[random() % 7];
  Isometry3d X_WA_end = X_WA, X_WB_end = X_WB;
  X_WA_end.translation() += a;
  X_WB_end.translation() += b;
  return pairCycle({X_WA, X_WA_end}, {X_WB, X_WB_end});
}

void playSlide(WholeDuel& whole, Random& random, Tally& tally) {
  const CycleMotion motion = slide(random, whole.duel.bound());
  whole.duel.monitor().reset();
  const PairResult& result = whole.duel.monitor().run(motion, {false, 0}).pairs.at(0);
  whole.duel.judge(motion, result, whole.duel.name() + " slide", tally);
  const Sweep exact = truth(whole, motion);
  if (tally.cases % 16 == 0) {
    const double bound = whole.duel.bound();
    const LeastOptions options{0.1L * bound, 4 * bound, -4 * bound, 500};
    ++tally.placed;
    tally.near += exact == Sweep::kTouch || std::abs(whole.duel.least(motion, {0, 1}, options).high) < 3 * bound;
  }
  if (exact == Sweep::kTouch && result.verdict == Verdict::kClear) {
    ++tally.false_clear;
    tally.fail(whole.duel.name() + ": CLEAR", "they touch");
  }
  if (exact == Sweep::kTouch && result.verdict == Verdict::kContact) {
    ++tally.false_bound;
    tally.fail(whole.duel.name() + ": CONTACT", "they only touch");
  }
  if (exact == Sweep::kApart && result.verdict == Verdict::kContact) {
    ++tally.false_contact;
    tally.fail(whole.duel.name() + ": CONTACT", "they are apart");
  }
}

/// Plays motions with arbitrary twists that start or end with exact touch.
void playInstant(WholeDuel& whole, Random& random, Tally& tally) {
  CycleMotion rest = slide(random, whole.duel.bound());
  for (auto& poses : rest.X_WB) poses[1] = poses[0];
  if (truth(whole, rest) != Sweep::kTouch) return;
  const Isometry3d &X_WA = rest.X_WB[0][0], &X_WB = rest.X_WB[1][0];
  const Vector3d about = uniform(random, 0.0, 1.0) < 0.5 ? X_WB.translation() : latticePoint(random, 8);
  const double far = random() % 2 ? 0.3 : 0.02;
  const Isometry3d X_WA_end =
      screwed(X_WA, about, uniform(random, 0.0, 2.0) * direction(random), far * direction(random));
  const Isometry3d X_WB_end =
      screwed(X_WB, about, uniform(random, 0.0, 2.0) * direction(random), far * direction(random));
  CycleMotion motion = pairCycle({X_WA, X_WA_end}, {X_WB, X_WB_end});
  const bool at_end = random() % 2;
  if (at_end)
    for (auto& poses : motion.X_WB) std::swap(poses[0], poses[1]);
  const PairResult& result = whole.duel.play(motion, tally);
  if (tally.cases % 16 == 0) ++tally.placed, ++tally.near;
  if (result.verdict != Verdict::kClear) return;
  ++tally.false_clear;
  tally.fail(whole.duel.name() + ": CLEAR", at_end ? "they touch at the end" : "they touch at the start");
}

/// Plays motions of parallel faces whose gap or depth is exactly the reported error bound, or one ulp more or less.
void playUlp(WholeDuel& whole, Random& random, Tally& tally) {
  Duel& duel = whole.duel;
  const double heights[] = {duel.bound(), duel.monitor().run(slide(random, 0.0), {false, 0}).error_bound};
  double gap = heights[random() % 2] * (random() % 2 ? 1.0 : -1.0);
  const int ulp = int(random() % 3) - 1;
  if (ulp != 0) gap = std::nextafter(gap, ulp * std::numeric_limits<double>::infinity());
  Real top = 0, bottom = 0;
  for (const Convex& piece : duel.a().solid)
    for (const Vector3l& p : piece.corners) top = std::max(top, p.z());
  for (const Convex& piece : duel.b().solid)
    for (const Vector3l& p : piece.corners) bottom = std::min(bottom, p.z());
  Isometry3d X_WB = Isometry3d::Identity();
  X_WB.translation() = Vector3d(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1), double(top - bottom) + gap);
  Isometry3d X_WB_end = X_WB;
  X_WB_end.translation().head<2>() += Eigen::Vector2d(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1));
  duel.play(pairCycle({2, Isometry3d::Identity()}, {X_WB, X_WB_end}), tally);
  if (tally.cases % 16 == 0) ++tally.placed, ++tally.near;
}

}  // namespace

Tally degenerate(std::uint64_t seed, long cases) {
  Random random(seed);
  std::vector<WholeDuel> all = duels();
  Tally tally;
  while (tally.cases < cases) {
    WholeDuel& whole = all[random() % all.size()];
    switch (random() % 4) {
      case 0:
        playUlp(whole, random, tally);
        break;
      case 1:
        playInstant(whole, random, tally);
        break;
      default:
        playSlide(whole, random, tally);
    }
  }
  return tally;
}

}  // namespace sdf_ccd::test
