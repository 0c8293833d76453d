#include "query/shell_distance.h"

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::shell_distance_test {

using test::Random;

TEST(ShellDistance, IsThatOfTheNearestPointOfAll) {
  Random random(4);
  PointShell shell;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d out = test::direction(random);
    shell.add(0.2 * out, out, 1e-4F);
  }
  const SphereTree tree = buildSphereTree(shell);
  const DistanceField field{Primitive(Box{Vector3d(0.1, 0.2, 0.3)})};
  std::vector<int> pending;
  int inside = 0, none = 0;
  for (int i = 0; i < 300; ++i) {
    const Isometry3d X_FP = test::pose(random, 3.0, 0.9);
    double least = 1e300;
    for (const Vector3d& p : shell.points()) least = std::min(least, field.sample(X_FP * p).value);
    const double range = test::uniform(random, 0.0, 0.6);
    const ShellDistance found = shellDistance(field, shell, tree, X_FP, range, pending);
    if (least > range) {
      EXPECT_EQ(found.point, -1);
      ++none;
      continue;
    }
    ASSERT_GE(found.point, 0);
    EXPECT_EQ(found.value, least);
    EXPECT_LE(found.error, 1e-12);
    EXPECT_EQ(found.p_F, X_FP * shell.point(found.point));
    inside += least < 0.0;
  }
  EXPECT_GT(inside, 30);
  EXPECT_GT(none, 30);
}

}  // namespace sdf_ccd::shell_distance_test
