/// Time to bound the separation of two triangle surfaces over a cycle, compared with FCL at the cycle's end, and the
/// distance of two triangles, compared with FCL's. Prints rows of results.csv.
#include <algorithm>
#include <cmath>
#include <deque>

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>
#include <fcl/narrowphase/distance.h>

#include "fcl_model.h"
#include "oracle/random.h"
#include "oracle/rounded_triangles.h"
#include "oracle/shapes.h"
#include "study.h"
#include "surface/separation.h"
#include "surface/triangle_pairs_scalar.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr double kTravel = 0.003, kTurn = 0.003;  // per cycle, in longest sides of the mesh and [rad]

struct Placement {
  std::string name;
  double gap;  // in longest sides of the mesh; negative: moved on into each other by this
};
const std::vector<Placement> kPlacements = {
    {"apart_30%", 0.3}, {"apart_1%", 0.01}, {"apart_0.1%", 0.001}, {"crossing", -0.02}};

/// Two copies A and B of a mesh; A rests.
class Surfaces {
 public:
  explicit Surfaces(const TriangleMesh& mesh)
      : tree(test::treeOf(mesh)), model(fclModel(mesh)), side(boundingBox(mesh).sizes().maxCoeff()) {}

  bool touch(const Isometry3d& X_AB) const {
    fcl::CollisionResultd result;
    return fcl::collide(model.get(), Isometry3d::Identity(), model.get(), X_AB, fcl::CollisionRequestd(), result) > 0;
  }
  double distance(const Isometry3d& X_AB) const {
    fcl::DistanceResultd result;
    return fcl::distance(model.get(), Isometry3d::Identity(), model.get(), X_AB, fcl::DistanceRequestd(), result);
  }

  /// A pose of B with a random orientation, moved along a line from far away until only the gap is left.
  Isometry3d place(double gap, test::Random& random) const {
    const Vector3d from = test::direction(random);
    Isometry3d X_AB = test::pose(random, 3.0, 0.0);
    X_AB.translation() = 4.0 * side * from + tree.origin() - X_AB.linear() * tree.origin();
    const double wanted = std::max(gap, 1e-4) * side;
    for (double free = side; free > 1e-5 * side && X_AB.translation().dot(from) > -4.0 * side;) {
      free = distance(X_AB) - wanted;
      X_AB.translation() -= std::max(free, 0.0) * from;
    }
    if (gap < 0.0) X_AB.translation() += gap * side * from;
    return X_AB;
  }

  BoxTree tree;
  std::unique_ptr<FclModel> model;
  double side;  // [m]
};

/// A cycle of B, and the witness kept from the previous query of it.
struct Cycle {
  Cycle(const Surfaces& surfaces, const Placement& placement, test::Random& random)
      : X_WA(Isometry3d::Identity(), Isometry3d::Identity()), X_WB(motionOf(surfaces, placement, random)) {
    const BoundingBall& ball = surfaces.tree.ball();
    acceleration = relativeMotionBounds(worldTwist(X_WA, ball), worldTwist(X_WB, ball)).acceleration;
  }

  static ScrewMotion motionOf(const Surfaces& surfaces, const Placement& placement, test::Random& random) {
    const Isometry3d X_start = surfaces.place(placement.gap, random);
    Isometry3d X_end = X_start;
    X_end.linear() = Eigen::AngleAxisd(kTurn, test::direction(random)) * X_start.linear();
    X_end.translation() += kTravel * surfaces.side * test::direction(random);
    return {X_start, X_end};
  }

  Separation run(const Surfaces& surfaces, SeparationWitness& kept) const {
    return separation(surfaces.tree, surfaces.tree, {0.0, 1e-3, X_WA, X_WB, acceleration}, {}, kept, memory());
  }

  static SeparationMemory& memory() {
    static SeparationMemory memory;
    return memory;
  }

  ScrewMotion X_WA, X_WB;
  double acceleration;
  SeparationWitness witness;
};

void study(const NamedMesh& named, const Placement& placement, const StudyOptions& options) {
  const Surfaces surfaces(named.mesh);
  test::Random random(1);
  std::deque<Cycle> cycles;
  for (int i = 0; i < options.pairs; ++i) cycles.emplace_back(surfaces, placement, random);

  const std::string name = named.name + "/" + placement.name;
  double apart = 0.0, crossing = 0.0, tight = 0.0;
  for (Cycle& cycle : cycles) {
    const Separation found = cycle.run(surfaces, cycle.witness);
    apart += found.state == SeparationState::kApart;
    crossing += found.state == SeparationState::kCrossing;
    if (found.state == SeparationState::kApart) tight += found.distance / surfaces.distance(cycle.X_WB.end());
  }
  const auto each = [&cycles](const auto& work) {
    return [&cycles, work](std::size_t) {
      for (Cycle& cycle : cycles) work(cycle);
      return cycles.size();
    };
  };
  const std::vector<Task> tasks = {
      {"separation", each([&](Cycle& cycle) {
         SeparationWitness none;
         cycle.run(surfaces, none);
       })},
      {"separation_again", each([&](Cycle& cycle) { cycle.run(surfaces, cycle.witness); })},
      {"fcl_collide", each([&](Cycle& cycle) { surfaces.touch(cycle.X_WB.end()); })},
      {"fcl_distance", each([&](Cycle& cycle) { surfaces.distance(cycle.X_WB.end()); })}};
  const std::vector<Spread> spreads = measure(tasks, options.measure);
  for (std::size_t k = 0; k < tasks.size(); ++k)
    print({"separation", name, tasks[k].system, "us_per_pair", 0.0, "us", options.measure.runs}, spreads[k], 1e6);
  const auto share = [&](const char* metric, double value) {
    print({"separation", name, "separation", metric, value, "of pairs", 1});
  };
  share("apart", apart / options.pairs);
  share("crossing", crossing / options.pairs);
  if (apart > 0.0) print({"separation", name, "separation", "bound", tight / apart, "of FCL's distance at the end", 1});
}

Corners triangle(test::Random& random, double away) {
  Corners t;
  for (Vector3d& p : t) p = Vector3d(away, 0, 0) + test::uniform(random, 0.1, 1.0) * test::direction(random);
  return t;
}

void studyTriangles(const StudyOptions& options) {
  constexpr int kGroups = 128;
  test::Random random(1);
  std::vector<TrianglePairs> groups(kGroups);
  std::vector<std::pair<Corners, Corners>> pairs;
  for (TrianglePairs& group : groups)
    while (group.size < TrianglePairs::kSize) {
      pairs.emplace_back(triangle(random, 0.0), triangle(random, 1.5));
      group.add(pairs.back().first, pairs.back().second);
    }
  const EndPoses poses{Isometry3d::Identity(), test::pose(random, 0.003, 0.003)};
  const auto each = [&groups](const auto& work) {
    return [&groups, work](std::size_t) {
      for (TrianglePairs& group : groups) work(group);
      return groups.size() * TrianglePairs::kSize;
    };
  };
  double sum = 0.0;  // keeps the compiler from removing the calls
  const std::vector<Task> tasks = {
      {"planes", each([&](TrianglePairs& group) { planeGaps(poses, Vector3d::UnitX(), group); })},
      {"closest", each([&](TrianglePairs& group) { closestGaps(poses, group); })},
      {"closest_one_by_one", each([&](TrianglePairs& group) { closestGapsOneByOne(poses, group); })},
      {"fcl", [&](std::size_t) {
         for (const auto& [a, b] : pairs) {
           Vector3d p, q;
           sum += fcl::detail::TriangleDistanced::triDistance(a.data(), b.data(), p, q);
         }
         return pairs.size();
       }}};
  const std::vector<Spread> spreads = measure(tasks, options.measure);
  for (std::size_t k = 0; k < tasks.size(); ++k)
    print(
        {"separation", "triangles", tasks[k].system, "ns_per_pair", sum > 0.0 ? 0.0 : 1.0, "ns", options.measure.runs},
        spreads[k], 1e9);
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.pairs = 200;
  StudyOptions quick = full;
  quick.pairs = 20;
  quick.meshes = {"torus", "box"};
  return runStudy(argc, argv, "Surfaces of triangles that move, beside FCL", full, quick,
                  [](const StudyOptions& options) {
                    if (isWanted(options.cases, "triangles")) studyTriangles(options);
                    for (const NamedMesh& mesh : studyMeshes(options))
                      for (const Placement& placement : kPlacements)
                        if (isWanted(options.cases, placement.name)) study(mesh, placement, options);
                  });
}
