#include <gtest/gtest.h>

#include "oracle/open_shapes.h"
#include "oracle/random.h"
#include "oracle/rounds.h"
#include "oracle/scene_case.h"
#include "oracle/triangle_distance.h"
#include "sdf_ccd/mesh.h"

/// Searches for motions of open meshes with the verdict CONTACT although their triangles never meet, or CLEAR although
/// they do.
namespace sdf_ccd::open_mesh_attack_test {

using test::Random;

/// A solid with holes: a missing patch, or single triangles missing; with or without cracks.
TriangleMesh openMesh(Random& random, double size) {
  const int kind = int(random() % 3);
  TriangleMesh mesh = kind == 0   ? test::boxMesh(size * Vector3d(1, test::uniform(random, 0.1, 1), 0.8))
                      : kind == 1 ? test::icosphere(size, 1)
                                  : test::torusMesh(0.7 * size, 0.3 * size, 8, 6);
  const Vector3d side = test::direction(random);
  const double from = test::uniform(random, 0.0, 0.9) * size, share = random() % 2 ? 0.1 : 0.0;
  mesh =
      test::without(mesh, [&](const Vector3d& p) { return p.dot(side) > from || test::uniform(random, 0, 1) < share; });
  if (random() % 3 == 0) {  // cracks along all edges
    TriangleMesh cracked;
    for (const Vector3i& t : mesh.triangles) {
      const int first = static_cast<int>(cracked.vertices.size());
      for (int k = 0; k < 3; ++k) {
        cracked.vertices.push_back(mesh.vertices[t[k]] + 1e-5 * size * test::direction(random));
      }
      cracked.triangles.emplace_back(first, first + 1, first + 2);
    }
    mesh = std::move(cracked);
  }
  return mesh;
}

struct Case {
  TriangleMesh a, b;  // oriented as in the scene
  std::shared_ptr<const Scene> scene;
};

Case makeCase(Random& random) {
  Case made;
  do {
    made.a = openMesh(random, test::uniform(random, 0.05, 0.15));
    made.b = openMesh(random, 0.3);
  } while (made.a.triangles.empty() || made.b.triangles.empty());
  BodyOptions options = test::fine(0.02);
  options.field.cells.reset();
  options.field.max_error = 0.01;
  made.scene =
      test::build({test::body("a", test::meshShape(made.a)), test::body("b", test::meshShape(made.b))}, options);
  made.a = orientOutward(made.a).mesh;
  made.b = orientOutward(made.b).mesh;
  return made;
}

/// A translation of A along a straight line.
struct Path {
  Vector3d start, end;
};

Verdict verdictOf(Monitor& monitor, const Path& path) {
  monitor.reset();
  const auto at = [](const Vector3d& p) { return Isometry3d(Eigen::Translation3d(p)); };
  return monitor
      .run(test::cycle(0.1, {{at(path.start), at(path.end)}, test::still(Isometry3d::Identity())}), {false, 0})
      .verdict;
}

/// Bounds of the smallest distance of the triangles along the path; distances change by no more than positions.
struct Least {
  double low, high;
};
Least leastDistance(const Case& made, const Path& path, int steps) {
  const double step = (path.end - path.start).norm() / steps;
  double high = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    const Vector3d p = path.start + double(i) / steps * (path.end - path.start);
    high = std::min(high, double(test::meshDistance(made.b, made.a, p)));
  }
  return {high - 0.5 * step, high};
}

TEST(OpenMeshAttack, ContactsAreCrossingsAndWhatIsClearIsFree) {
  Random random(1);
  int count[4] = {};
  for (int i = 0; i < test::rounds(10); ++i) {
    const Case made = makeCase(random);
    Monitor monitor(made.scene, {});
    for (int k = 0; k < 12; ++k) {
      const Vector3d middle = test::uniform(random, 0.0, 0.5) * test::direction(random);
      const Vector3d half = test::uniform(random, 0.0, k % 2 ? 0.3 : 0.03) * test::direction(random);
      const Path path{middle - half, middle + half};
      const Verdict verdict = verdictOf(monitor, path);
      ++count[static_cast<int>(verdict)];
      if (verdict == Verdict::kUncertain) continue;
      const Least least = leastDistance(made, path, 24);
      ASSERT_FALSE(verdict == Verdict::kContact && least.low > 1e-6) << "case " << i << ", path " << k;
      ASSERT_FALSE(verdict == Verdict::kClear && least.high < 1e-6) << "case " << i << ", path " << k;
    }
  }
  EXPECT_GT(count[static_cast<int>(Verdict::kClear)], test::rounds(10));
  EXPECT_GT(count[static_cast<int>(Verdict::kContact)], test::rounds(20));
}

/// Climbs: keeps a change of the path if the verdict stays and the true distance moves away from it.
TEST(OpenMeshAttack, ClimbingFindsNoFalseVerdict) {
  Random random(2);
  for (const Verdict wanted : {Verdict::kContact, Verdict::kClear}) {
    const double sign = wanted == Verdict::kContact ? 1.0 : -1.0;
    for (int i = 0; i < test::rounds(10); ++i) {
      const Case made = makeCase(random);
      Monitor monitor(made.scene, {});
      double best = -1e9;
      Path path{};
      for (int k = 0; k < 60; ++k) {
        const bool found = best > -1e9;
        const double change = found ? 0.1 * std::pow(0.93, k) : 0.4;
        Path next = path;
        next.start += change * test::direction(random);
        next.end = found ? Vector3d(next.end + change * test::direction(random))
                         : Vector3d(next.start + 0.1 * test::direction(random));
        if (verdictOf(monitor, next) != wanted) continue;
        const Least least = leastDistance(made, next, 16);
        ASSERT_FALSE(wanted == Verdict::kContact && least.low > 1e-6) << "case " << i << ", step " << k;
        ASSERT_FALSE(wanted == Verdict::kClear && least.high < 1e-6) << "case " << i << ", step " << k;
        const double value = sign * least.high;
        if (value < best) continue;
        best = value;
        path = next;
      }
    }
  }
}

/// A tessellation as fine as the disc is thin would have too many triangles.
TEST(OpenMeshAttack, ADiscOfHardlyAnyThickness) {
  const auto scene = test::build({test::body("bin", test::meshShape(test::binMesh(0.2))),
                                  test::body("disc", Primitive(Cylinder::fromRadiusAndLength(0.5, 2e-12)))});
  EXPECT_TRUE(scene->bodies[1].failure.empty()) << scene->bodies[1].failure;
  Monitor monitor(scene, test::soft());
  const auto verdictAt = [&](const Vector3d& p) {
    return monitor.run(test::cycle(0.1, {test::still(Isometry3d::Identity()), test::still(test::translation(p))}), {})
        .verdict;
  };
  EXPECT_EQ(verdictAt({0, 0, 0.5}), Verdict::kClear);
  EXPECT_EQ(verdictAt({0, 0, 0}), Verdict::kContact);
}

}  // namespace sdf_ccd::open_mesh_attack_test
