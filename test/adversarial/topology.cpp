#include <algorithm>
#include <array>

#include "adversarial/drawn.h"
#include "oracle/files.h"
#include "oracle/shapes.h"

/// The family `topology`: all pairs of the bodies in drawn.h, one wholly inside the other, passing through thin walls,
/// or near the surface.
namespace sdf_ccd::test {
namespace {

constexpr long kCasesPerPair = 150;  // as building a scene takes longer than running so many cases
constexpr double kReach = 0.5;       ///< of positions within larger bodies, and of travel [m]
constexpr std::size_t kSurePairs = 16;
constexpr std::array<double, 3> kCoarse = {1.0, 2.0, 4.0};

struct Pairing {
  std::size_t a, b;
};

/// All pairs that can be checked: first those that once gave wrong verdicts, then the others, shuffled.
std::vector<Pairing> pairings(const std::vector<Actor>& actors, Random& random) {
  std::vector<Pairing> all{{1, 0},  {3, 2},  {4, 2},  {5, 6},   {1, 7},   {8, 0},  {1, 18}, {1, 19},
                           {23, 6}, {1, 24}, {1, 25}, {27, 26}, {27, 24}, {20, 2}, {21, 2}, {22, 2}};
  for (std::size_t a = 0; a < actors.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b)
      if (!actors[a].is_field_only || !actors[b].is_field_only) all.push_back({a, b});
  std::shuffle(all.begin() + kSurePairs, all.end(), random);
  return all;
}

/// @param coarse  factor of the errors; 1 as for a robot. Larger errors are as hard to keep, and cheaper.
Duel makeDuel(const Actor& a, const Actor& b, double coarse, const std::string& cache) {
  BodyOptions scene;
  scene.field.max_error = coarse * 2e-3;
  scene.shell.spacing = coarse * 0.02;
  scene.shell.edge_gap = coarse * 4e-3;
  scene.cache_directory = cache;
  MonitorOptions monitor;
  monitor.chords.tolerance = 2e-4;
  return Duel(a, b, scene, monitor);
}

Vector3d anywhereIn(const Actor& actor, Random& random) {
  AlignedBox3d box;
  for (const Convex& piece : actor.solid)
    for (const Vector3l& p : piece.corners) box.extend(p.cast<double>());
  return uniformIn(random, box.intersection({Vector3d::Constant(-kReach), Vector3d::Constant(kReach)}));
}

/// A motion with little or no movement, and the centre of B within A's bounding box.
CycleMotion within(const Duel& duel, Random& random) {
  const Isometry3d X_WA = pose(random, 3.0, 0.5);
  Isometry3d X_WB = random() % 2 ? X_WA : pose(random, 3.0, 0.0);
  // The centre of B, or of one of its pieces.
  const Convex& piece = duel.b().solid[random() % duel.b().solid.size()];
  X_WB.translation() = X_WA * anywhereIn(duel.a(), random) - X_WB.linear() * piece.center.cast<double>();
  const double angle = random() % 3 == 0 ? 0.0 : 0.3, way = random() % 2 ? 0.0 : 0.12;
  const Vector3d a = angle * direction(random), b = angle * direction(random);
  return pairCycle({X_WA, screwed(X_WA, X_WA.translation(), a, Vector3d::Zero())},
                   {X_WB, screwed(X_WB, X_WB.translation(), b, way * direction(random))});
}

/// A motion in which the bodies pass each other.
CycleMotion past(const Duel& duel, Random& random) {
  CycleMotion motion = within(duel, random);
  const Vector3d way = std::min(duel.size(), kReach) * uniform(random, 0.1, 1.5) * direction(random);
  motion.X_WB[1][0].translation() -= 0.5 * way;
  motion.X_WB[1][1].translation() += 0.5 * way;
  return motion;
}

void play(Duel& duel, long cases, Random& random, Tally& tally) {
  for (const long end = tally.cases + cases; tally.cases < end;) {
    CycleMotion motion = random() % 2 ? within(duel, random) : past(duel, random);
    if (random() % 2) {
      duel.play(motion, tally);
      continue;
    }
    const Vector3d axis = duel.aim(0.0, motion);
    for (int i = 0; i < 3 && tally.cases < end; ++i) {
      CycleMotion shifted = motion;
      shiftB(uniform(random, -3.0, 3.0) * duel.bound() * axis, shifted);
      duel.play(shifted, tally);
      if (tally.cases % 16 != 0) continue;
      ++tally.placed;
      const LeastOptions options{0.1L * duel.bound(), 4 * duel.bound(), -4 * duel.bound(), 500};
      tally.near += std::abs(duel.least(shifted, {0, 1}, options).high) < 3.0 * duel.bound();
    }
  }
}

}  // namespace

Tally topology(std::uint64_t seed, long cases) {
  Random random(seed);
  const std::vector<Actor> actors = drawnActors();
  const std::vector<Pairing> all = pairings(actors, random);
  const long used = std::min(long(all.size()), std::max(1L, cases / kCasesPerPair));
  const TemporaryDirectory cache;  // so that the fields and shells of a body are built once
  Tally tally;
  for (long i = 0; i < used; ++i) {
    const auto [a, b] = all[std::size_t(i)];
    Duel duel = makeDuel(actors[a], actors[b], kCoarse[random() % kCoarse.size()], cache.path());
    play(duel, cases * (i + 1) / used - cases * i / used, random, tally);
  }
  return tally;
}

}  // namespace sdf_ccd::test
