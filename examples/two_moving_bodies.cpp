// Two bodies that both move and are apart at the start and at the end: finds that they touch in between.
#include <cstdio>

#include <sdf_ccd/sdf_ccd.h>

namespace {

using namespace sdf_ccd;

Isometry3d at(double x, double y) {
  return Isometry3d(Eigen::Translation3d(x, y, 0.0));
}

}  // namespace

int main() {
  // A plate 1 mm thick and a rod. Their poses are given before and after they pass through each other.
  const Accuracy accuracy{1e-3, {}};
  Monitor monitor({prepareBody("plate", Box::fromSize({0.4, 0.001, 0.4}), accuracy),
                   prepareBody("rod", Box::fromSize({0.02, 0.1, 0.02}), accuracy)});
  const CycleResult& result = monitor.check({{at(0.0, 0.2), at(0.0, -0.2)}, {at(0.0, -0.2), at(0.0, 0.2)}}, 0.1);
  std::printf("%s, within %.2g m\n", toString(result.verdict), result.error_bound);
  for (const PairResult& pair : result.pairs)
    for (const Interval& interval : pair.intervals)
      std::printf("in contact from %.4f s to %.4f s, %.2g m deep\n", interval.enter, interval.exit, pair.deepest.depth);
  return result.verdict == Verdict::kContact ? 0 : 1;
}
