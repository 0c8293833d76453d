#include <algorithm>
#include <array>
#include <cmath>

#include "adversarial/drawn.h"
#include "adversarial/duel.h"
#include "oracle/shapes.h"

/// The family `search`: hill climbing for the deepest true overlap while the verdict is CLEAR, over runs of cycles with
/// skipped pairs, late frames, jumps, partial spans, spins and approaches, inexact motions, and cycles that have no
/// time for the pair.
namespace sdf_ccd::test {
namespace {

constexpr int kCycles = 5;    // per run
constexpr int kSteps = 3;     // between given poses, per cycle
constexpr int kPerStep = 12;  // numbers per step: the twists of both bodies
constexpr int kErrors = 6;    // numbers: displacements of the bodies from the motion's poses
constexpr int kNumbers = 12 + kCycles * kSteps * kPerStep + kErrors;
constexpr int kPatience = 60;  // tries without improvement before the search restarts
constexpr double kLargestAngle = 3.0;

/// How a cycle's transforms arrive.
enum class Arrival { kAll, kNone, kFirstStep, kLastSteps, kJump };

/// The variables of the search.
struct Genes {
  std::vector<double> numbers;    ///< both poses at the start, twists, and errors
  std::vector<Arrival> arrivals;  ///< per cycle
  std::vector<char> in_time;      ///< per cycle: whether there is time for the pair
  bool is_exact = true;           ///< the errors are zero

  static Genes random(Random& random) {
    Genes genes;
    const double calm = logUniform(random, 0.01, 1.0);
    for (int i = 0; i < kNumbers; ++i) genes.numbers.push_back(uniform(random, -1.0, 1.0) * (i < 12 ? 1.0 : calm));
    for (int c = 0; c < kCycles; ++c) genes.arrivals.push_back(Arrival(random() % 8 < 4 ? 0 : 1 + random() % 4));
    for (int c = 0; c < kCycles; ++c) genes.in_time.push_back(random() % 2 != 0);
    genes.is_exact = random() % 2 != 0;
    return genes;
  }

  Genes changed(Random& random, double size) const {
    Genes genes = *this;
    const bool all = random() % 4 == 0;
    for (double& x : genes.numbers)
      if (all || random() % 16 == 0) x += size * uniform(random, -1.0, 1.0);
    for (Arrival& arrival : genes.arrivals)
      if (random() % 20 == 0) arrival = Arrival(random() % 5);
    for (char& in_time : genes.in_time)
      if (random() % 20 == 0) in_time = in_time == 0;
    return genes;
  }
};

/// All cycles of a run as a tracker would pass them on: poses that arrive late are in the next cycle's span.
std::vector<CycleMotion> cyclesOf(const Genes& genes, double reach) {
  const double* next = genes.numbers.data();
  const auto vector = [&](double scale) {
    const Vector3d v(next[0], next[1], next[2]);
    next += 3;
    return Vector3d(scale * v);
  };
  const auto rotation = [&] {
    const Vector3d v = vector(kLargestAngle / std::sqrt(3.0));
    return v.norm() > kLargestAngle ? Vector3d(kLargestAngle * v.normalized()) : v;
  };
  std::vector<Isometry3d> now(2, Isometry3d::Identity());
  for (Isometry3d& X : now) {
    const Vector3d turn = rotation();
    X = screwed(X, Vector3d::Zero(), turn, vector(reach));
  }
  std::vector<CycleMotion> cycles;
  std::vector<std::vector<Isometry3d>> late(2);  // the last pose covered by a span, and the later ones
  for (const Arrival arrival : genes.arrivals) {
    std::vector<std::vector<Isometry3d>> poses{{now[0]}, {now[1]}};
    if (arrival == Arrival::kJump) late[0].clear();
    if (!late[0].empty()) poses = late;
    for (int step = 0; step < kSteps; ++step) {
      for (int b = 0; b < 2; ++b) {
        const Vector3d turn = rotation(), shift = vector(0.5 * reach);
        // Rotates about the frame's origin, where an arm's joint is.
        now[b] = screwed(now[b], now[b].translation(), turn, shift);
        poses[b].push_back(now[b]);
      }
    }
    CycleMotion motion = pairCycle(poses[0], poses[1]);
    const std::size_t last = motion.times.size() - 1;
    WaypointSpan span{0, last};
    if (arrival == Arrival::kNone) span.last = 0;
    if (arrival == Arrival::kFirstStep) span.last = 1;
    if (arrival == Arrival::kLastSteps) span.first = last - 1;  // as after a gap
    motion.spans = {span};
    for (int b = 0; b < 2; ++b) late[b].assign(poses[b].begin() + long(span.last), poses[b].end());
    if (span.last == last) late[0].clear();
    // A jump: the next cycle begins elsewhere.
    if (arrival == Arrival::kJump) now[1].translation() += Vector3d(0.0, 0.0, 0.1 * reach);
    cycles.push_back(std::move(motion));
  }
  return cycles;
}

/// Constant displacement of each body from the motion's poses [m].
std::array<Vector3d, 2> errorsOf(const Genes& genes) {
  constexpr double kLargest = 3e-3;
  std::array<Vector3d, 2> errors;
  for (int b = 0; b < 2; ++b) {
    const double* own = genes.numbers.data() + kNumbers - kErrors + 3 * b;
    errors[b] = genes.is_exact ? Vector3d::Zero() : Vector3d(kLargest * Vector3d(own[0], own[1], own[2]));
  }
  return errors;
}

class Climb {
 public:
  Climb(Duel& duel, Tally& tally) : duel_(duel), tally_(tally) {}

  /// The value to maximise [m]: the deepest overlap of a run while CLEAR; without overlap, the negative minimum
  /// distance.
  Real value(const Genes& genes) {
    Real deepest = -std::numeric_limits<Real>::infinity();
    duel_.monitor().reset();
    const std::array<Vector3d, 2> errors = errorsOf(genes);
    auto in_time = genes.in_time.begin();
    for (CycleMotion& motion : cyclesOf(genes, 0.5 * duel_.size())) {
      for (const Vector3d& error : errors) motion.motion_error.push_back((1.0 + 1e-12) * error.norm());
      const PairResult& result = duel_.follow(motion, *in_time++ != 0);
      if (result.span.empty()) continue;
      for (int b = 0; b < 2; ++b)
        for (Isometry3d& X : motion.X_WB[b]) X.translation() += errors[b];
      const long before = tally_.false_clear;
      duel_.judge(motion, result, duel_.name(), tally_);
      if (result.verdict != Verdict::kClear) continue;
      const LeastOptions options{0.1L * duel_.bound(), -deepest};  // only smaller separations matter
      const LeastValue least = duel_.least(motion, result.span, options);
      if (tally_.false_clear == before) {
        ++tally_.placed;
        tally_.near += least.high < 3.0 * duel_.bound();
      }
      deepest = std::max(deepest, -least.high);
    }
    return deepest;
  }

 private:
  Duel& duel_;
  Tally& tally_;
};

std::vector<Duel> duels() {
  const Vector3d arm(0.4, 0.02, 0.02), reach(0.4, 0.0, 0.0);
  BodyOptions scene;
  scene.field.max_error = 1e-3;
  scene.shell.spacing = 0.04;
  scene.shell.edge_gap = 2e-3;
  MonitorOptions options;
  options.chords.tolerance = 2e-4;
  std::vector<Duel> all;
  const auto add = [&](const Actor& a, const Actor& b) { all.push_back(Duel::inCompany(a, b, scene, options)); };
  add(boxActor(arm, reach), boxActor(arm, reach));
  add(convexActor("block", boxMesh({0.15, 0.1, 0.01})), boxActor({0.05, 0.04, 0.03}));
  add(sleeve(), mapAndPost());
  add(paddedBin(), rod());
  return all;
}

}  // namespace

Tally search(std::uint64_t seed, long cases) {
  Random random(seed);
  std::vector<Duel> all = duels();
  Tally tally;
  while (tally.cases < cases) {
    Climb climb(all[random() % all.size()], tally);
    Genes best = Genes::random(random);
    Real highest = climb.value(best);
    double size = 0.3;
    for (int tries = 0; tries < kPatience && tally.cases < cases; ++tries) {
      const Genes next = best.changed(random, size);
      const Real value = climb.value(next);
      if (value > highest) {
        highest = value;
        best = next;
        tries = 0;
        size = std::min(1.5 * size, 0.5);
      } else {
        size = std::max(0.9 * size, 1e-4);
      }
    }
  }
  return tally;
}

}  // namespace sdf_ccd::test
