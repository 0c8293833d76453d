#include "scene_totals.h"

#include "pair_bound.h"

namespace sdf_ccd {
namespace {

bool isLarger(const ErrorBound& a, const ErrorBound& b) {
  return a.total() > b.total();
}

}  // namespace

void countPairs(Scene& scene) {
  for (BodyReport& report : scene.reports) report.pairs = 0;
  for (const PlannedPair& pair : scene.pairs) {
    ++scene.reports[pair.body_a].pairs;
    ++scene.reports[pair.body_b].pairs;
  }
}

void setBounds(double motion_margin, Scene& scene) {
  scene.bound = {};
  for (BodyReport& report : scene.reports) report.bound = {};
  for (const PlannedPair& pair : scene.pairs) {
    ErrorBound bound = pairBound(scene, pair);
    if (bound.total() == 0.0) continue;  // of a body that was not built
    bound.chord = motion_margin;
    for (ErrorBound* largest : {&scene.reports[pair.body_a].bound, &scene.reports[pair.body_b].bound, &scene.bound})
      if (isLarger(bound, *largest)) *largest = bound;
  }
}

}  // namespace sdf_ccd
