#include <gtest/gtest.h>

#include "cancel_moments.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"

namespace sdf_ccd::cancel_build_test {

using namespace test;
/// A body of two overlapping tori with many triangles, and an open mesh.
SceneDescription largeMeshes() {
  TriangleMesh torus = torusMesh(0.3, 0.1, 120, 40);
  TriangleMesh other = translated(torus, {0.05, 0.02, 0.01});
  const int offset = static_cast<int>(torus.vertices.size());
  torus.vertices.insert(torus.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (auto triangle : other.triangles) torus.triangles.push_back(triangle + decltype(triangle)::Constant(offset));
  TriangleMesh open = icosphere(0.2, 4);
  open.triangles.resize(open.triangles.size() * 3 / 4);
  return {{body("torus", meshShape(torus)), body("open", meshShape(open), true)}, {}};
}

constexpr int kMoments = 10;
constexpr double kSoon = 0.15;  // 0.2 s is the limit for unloading [s]

void expectBuildEndsSoon(const BodyOptions& options) {
  const SceneDescription description = largeMeshes();
  expectEndsSoon([&] { build(description, options); }, kMoments, kSoon);
}

TEST(CancelBuild, EndsSoonAtAnyMomentOfUniformFields) {
  BodyOptions options = fine(0.005);
  options.field.cells = 120;
  expectBuildEndsSoon(options);
}

TEST(CancelBuild, EndsSoonAtAnyMomentUnderMaxError) {
  BodyOptions options;
  options.max_error = 3e-3;
  options.divides_max_error = true;
  options.field.max_error = 1.65e-3;
  options.shell.edge_gap = 1.05e-3;
  options.shell.spacing = 5e-3;
  expectBuildEndsSoon(options);
}

}  // namespace sdf_ccd::cancel_build_test
