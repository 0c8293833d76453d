#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "oracle/shapes.h"
#include "scene/scene_case.h"
#include "sdf_ccd/geometry/cancel.h"

namespace sdf_ccd {
namespace {

using namespace test;
using Clock = std::chrono::steady_clock;

/// Seconds until a build ends that is cancelled after so many.
double timeToEnd(const SceneDescription& description, const SceneOptions& options, double cancelled_after) {
  std::atomic<bool> asked{false};
  Clock::time_point end;
  std::thread builder([&] {
    const CancelScope scope(asked);
    try {
      build(description, options);
    } catch (const Cancelled&) {
    }
    end = Clock::now();
  });
  std::this_thread::sleep_for(std::chrono::duration<double>(cancelled_after));
  const Clock::time_point start = Clock::now();
  asked = true;
  builder.join();
  return std::chrono::duration<double>(end - start).count();
}

double secondsOf(const SceneDescription& description, const SceneOptions& options) {
  const Clock::time_point start = Clock::now();
  build(description, options);
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Two parts of one body that overlap, of many triangles, and a sheet.
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

void expectEndsSoon(const SceneOptions& options) {
  constexpr int kMoments = 10;
  constexpr double kSoon = 0.15;  // of the 0.2 s that unloading may take [s]
  const SceneDescription description = largeMeshes();
  const double whole = secondsOf(description, options);
  double worst = 0.0, when = 0.0;
  for (int i = 0; i < kMoments; ++i) {
    const double after = whole * i / kMoments, took = timeToEnd(description, options, after);
    if (took > worst) when = after;
    worst = std::max(worst, took);
  }
  EXPECT_LT(worst, kSoon) << "cancelled after " << when << " of " << whole << " s";
}

TEST(CancelBuild, EndsSoonAtAnyMomentOfUniformFields) {
  SceneOptions options = fine(0.005);
  options.field.cells = 120;
  expectEndsSoon(options);
}

TEST(CancelBuild, EndsSoonAtAnyMomentUnderMaxError) {
  SceneOptions options;
  options.max_error = 3e-3;
  options.field.max_error = 1.65e-3;
  options.shell.edge_gap = 1.05e-3;
  options.shell.spacing = 5e-3;
  expectEndsSoon(options);
}

}  // namespace
}  // namespace sdf_ccd
