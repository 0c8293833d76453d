#include <cmath>
#include <memory>

#include "adversarial/duel.h"
#include "oracle/shapes.h"

/// The family `metamorphic`: variants of one case, such as translated, scaled, with another field, reversed in time.
/// Verdicts may become less certain, but never the opposite.
namespace sdf_ccd::test {
namespace {

constexpr double kScales[] = {1.0, 1e-6, 1e-4, 1e-2, 1e2, 1e5};
constexpr double kOffsets[] = {1.0, 1e2, 1e4, 1e6, 9e7};
constexpr double kSkew = 4e-7;  ///< of nearly orthonormal rotations

TriangleMesh tetrahedron(double size) {
  return {{{size, size, size}, {-size, -size, size}, {-size, size, -size}, {size, -size, -size}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

enum class Grid { kAdaptive, kFiner, kUniform };

BodyOptions optionsFor(Grid grid, double scale) {
  BodyOptions scene;
  if (grid == Grid::kAdaptive || grid == Grid::kFiner) {
    scene.field.max_error = scale * (grid == Grid::kFiner ? 2e-4 : 1e-3);
  } else {
    scene.field.cells = 32;
  }
  scene.shell.spacing = scale * (grid == Grid::kFiner ? 0.02 : 0.03);
  scene.shell.edge_gap = scale * (grid == Grid::kFiner ? 1e-3 : 3e-3);
  scene.motion_margin = scale * 1e-3;
  return scene;
}

struct Shapes {
  Actor a, b;
};

Shapes shapesOf(int which, double scale) {
  const Actor box = boxActor(scale * Vector3d(0.1, 0.06, 0.03));
  switch (which) {
    case 0:
      return {box, boxActor(scale * Vector3d(0.02, 0.15, 0.02), scale * Vector3d(0.0, 0.15, 0.0))};
    case 1:
      return {convexActor("tetrahedron", tetrahedron(0.1 * scale)), box};
    default:  // a plate whose thickness is a millionth of its width
      return {boxActor(scale * Vector3d(0.1, 0.1, 1e-7)),
              convexActor("box", boxMesh(scale * Vector3d(0.03, 0.03, 0.03)))};
  }
}

Duel makeDuel(int which, double scale, Grid grid, bool swapped = false) {
  MonitorOptions monitor;
  monitor.chords.tolerance = 1e-4 * scale;
  Shapes shapes = shapesOf(which, scale);
  if (swapped) std::swap(shapes.a, shapes.b);
  return Duel(std::move(shapes.a), std::move(shapes.b), optionsFor(grid, scale), monitor);
}

/// Duels for all variants of one pair of shapes.
struct Tellings {
  explicit Tellings(int which) : swapped(makeDuel(which, 1.0, Grid::kAdaptive, true)) {
    for (const double scale : kScales) scaled.push_back(makeDuel(which, scale, Grid::kAdaptive));
    for (const Grid grid : {Grid::kFiner, Grid::kUniform}) grids.push_back(makeDuel(which, 1.0, grid));
  }

  std::vector<Duel> scaled, grids;
  Duel swapped;
};

CycleMotion anyMotion(Random& random) {
  const auto step = [&](const Isometry3d& X) {
    return screwed(X, X.translation() + 0.2 * direction(random), logUniform(random, 0.01, 2.0) * direction(random),
                   uniform(random, 0.0, 0.2) * direction(random));
  };
  const Isometry3d X_WA = pose(random, 3.0, 0.2), X_WB = pose(random, 3.0, 0.2);
  return pairCycle({X_WA, step(X_WA)}, {X_WB, step(X_WB)});
}

template <class Change>
CycleMotion changed(CycleMotion motion, const Change& change) {
  for (auto& poses : motion.X_WB)
    for (Isometry3d& X : poses) change(X);
  return motion;
}

bool opposite(Verdict a, Verdict b) {
  return (a == Verdict::kClear && b == Verdict::kContact) || (a == Verdict::kContact && b == Verdict::kClear);
}

/// Plays the motion with nearly orthonormal rotations. The result must be true for these matrices or for the nearest
/// rotations.
void playSkewed(Duel& duel, const CycleMotion& motion, Random& random, Tally& tally) {
  const CycleMotion skewed = changed(motion, [&](Isometry3d& X) {
    for (int k = 0; k < 9; ++k) X.linear()(k / 3, k % 3) += uniform(random, -kSkew, kSkew);
  });
  const CycleMotion nearest = changed(skewed, [](Isometry3d& X) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(X.linear(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    X.linear() = svd.matrixU() * svd.matrixV().transpose();
  });
  duel.monitor().reset();
  const PairResult& result = duel.monitor().run(skewed, {false, 0}).pairs.at(0);
  Tally raw, rigid;
  duel.judge(skewed, result, duel.name() + " skewed", raw);
  duel.judge(nearest, result, duel.name() + " skewed", rigid);
  tally += raw.holds() ? raw : rigid;
}

class Telling {
 public:
  Telling(Tellings& tellings, const CycleMotion& motion, Tally& tally)
      : tellings_(tellings), motion_(motion), tally_(tally) {
    first_ = tellings.scaled[0].play(motion, tally).verdict;
  }

  void tell(Duel& duel, const CycleMotion& motion, const char* how) {
    const Verdict verdict = duel.play(motion, tally_).verdict;
    if (!opposite(first_, verdict)) return;
    // Opposite verdicts are allowed only if the separation is within the rounding of the poses.
    const LeastValue least = tellings_.scaled[0].least(motion_, {0, 1}, {1e-9L});
    if (std::abs(least.high) < 1e-7L) return;
    ++tally_.opposite;
    tally_.fail(duel.name() + ": opposite", how);
  }

 private:
  Tellings& tellings_;
  const CycleMotion& motion_;
  Tally& tally_;
  Verdict first_;
};

void tellAll(Tellings& tellings, const CycleMotion& motion, Random& random, Tally& tally) {
  Duel& plain = tellings.scaled[0];
  Telling telling(tellings, motion, tally);
  const double offset = kOffsets[random() % std::size(kOffsets)];
  const Vector3d by = offset * direction(random);
  telling.tell(plain, changed(motion, [&](Isometry3d& X) { X.translation() += by; }), "offset");
  const std::size_t scale = 1 + random() % (std::size(kScales) - 1);
  telling.tell(tellings.scaled[scale], changed(motion, [&](Isometry3d& X) { X.translation() *= kScales[scale]; }),
               "scaled");
  telling.tell(tellings.grids[random() % tellings.grids.size()], motion, "other field");
  CycleMotion backwards = motion;
  for (auto& poses : backwards.X_WB) std::swap(poses[0], poses[1]);
  telling.tell(plain, backwards, "backwards");
  CycleMotion swapped = motion;
  std::swap(swapped.X_WB[0], swapped.X_WB[1]);
  telling.tell(tellings.swapped, swapped, "swapped");
  playSkewed(plain, motion, random, tally);
}

}  // namespace

Tally metamorphic(std::uint64_t seed, long cases) {
  Random random(seed);
  std::vector<std::unique_ptr<Tellings>> all;
  for (int which = 0; which < 3; ++which) all.push_back(std::make_unique<Tellings>(which));
  Tally tally;
  while (tally.cases < cases) {
    Tellings& tellings = *all[random() % all.size()];
    Duel& plain = tellings.scaled[0];
    CycleMotion motion = anyMotion(random);
    const Vector3d axis = plain.aim(0.0, motion);
    for (int i = 0; i < 2; ++i) {
      CycleMotion shifted = motion;
      shiftB(uniform(random, -3.0, 3.0) * plain.bound() * axis, shifted);
      tellAll(tellings, shifted, random, tally);
      ++tally.placed;
      const LeastOptions options{0.1L * plain.bound(), 4 * plain.bound(), -4 * plain.bound(), 500};
      tally.near += std::abs(plain.least(shifted, {0, 1}, options).high) < 3.0 * plain.bound();
    }
  }
  return tally;
}

}  // namespace sdf_ccd::test
