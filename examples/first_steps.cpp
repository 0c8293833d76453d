// The README's example: a part, read from a mesh file, moves past a table and then through it.
#include <cstdio>
#include <fstream>

#include <sdf_ccd/sdf_ccd.h>

namespace {

/// Writes a cube with sides of 4 cm as OFF.
void writePart(const char* file) {
  std::ofstream(file) << "OFF\n8 12 0\n"
                         "-.02 -.02 -.02\n.02 -.02 -.02\n.02 .02 -.02\n-.02 .02 -.02\n"
                         "-.02 -.02 .02\n.02 -.02 .02\n.02 .02 .02\n-.02 .02 .02\n"
                         "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n"
                         "3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";
}

}  // namespace

int main() {
  using namespace sdf_ccd;
  writePart("part.off");
  const Accuracy mm{1e-3};
  const Body table = prepareBody("table", Box::fromSize({1.0, 1.0, 0.02}), mm),
             part = prepareBody("part", loadMesh("part.off"), mm);

  const Vector3d start(-0.1, 0.0, 0.0), end(0.1, 0.0, 0.0);
  const Intervals hits = segmentIntervals(part.field(), {start, end});
  for (const Interval& hit : hits) std::printf("a point is in the part from %.3f to %.3f\n", hit.enter, hit.exit);

  Monitor monitor({table, part});
  const Isometry3d X_WT = Isometry3d::Identity(), X_WP0(Eigen::Translation3d(0.0, 0.0, 0.2)),
                   X_WP1(Eigen::Translation3d(0.3, 0.0, 0.2)), X_WP2(Eigen::Translation3d(0.3, 0.0, -0.2));
  const Verdict past = monitor.check({{X_WT, X_WT}, {X_WP0, X_WP1}}).verdict;
  const CycleResult& cycle = monitor.check({{X_WT, X_WT}, {X_WP1, X_WP2}});
  std::printf("past the table: %s; through it: %s, within %.2g m\n", toString(past), toString(cycle.verdict),
              cycle.error_bound);
  return hits.size() == 1 && past == Verdict::kClear && cycle.verdict == Verdict::kContact ? 0 : 1;
}
