// What an editor keeps of objects that are gone.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "oracle/scene_case.h"
#include "oracle/shapes.h"
#include "scene/body_triangles.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::world_memory_test {

using namespace test;

/// An open sheet: its body needs a surface of its own, which is made in a second step.
TriangleMesh roughSheet(unsigned seed) {
  constexpr int kSide = 40;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(0.0, 0.05);
  TriangleMesh sheet;
  for (int i = 0; i <= kSide; ++i)
    for (int k = 0; k <= kSide; ++k) sheet.vertices.emplace_back(double(i) / kSide, double(k) / kSide, height(random));
  for (int i = 0; i < kSide; ++i) {
    for (int k = 0; k < kSide; ++k) {
      const int corner = i * (kSide + 1) + k;
      sheet.triangles.emplace_back(corner, corner + 1, corner + kSide + 2);
      sheet.triangles.emplace_back(corner, corner + kSide + 2, corner + kSide + 1);
    }
  }
  return sheet;
}

TEST(WorldMemory, OfObjectsThatAreGoneIsLimitedByTheirBytes) {
  WorldEditor editor(fine(0.02));
  std::vector<std::weak_ptr<const BodyTriangles>> made;
  for (unsigned i = 0; i < 24; ++i) {
    const SceneDescription world{
        {body("ball", meshShape(icosphere(0.1, 2))), body("sheet", meshShape(roughSheet(i)), true)}, {}};
    made.push_back(editor.next(world)->scene->bodies[1].triangles);
    ASSERT_FALSE(made.back().expired());
  }
  std::size_t kept = 0, bytes = 0;
  for (const auto& surface : made) {
    const auto alive = surface.lock();
    if (!alive) continue;
    ++kept;
    bytes += alive->bytes();
  }
  EXPECT_GE(kept, 2u) << "what is put back soon is not built again";
  EXPECT_LE(bytes, std::size_t{34} << 20);
  EXPECT_LT(kept, made.size());
}

}  // namespace sdf_ccd::world_memory_test
