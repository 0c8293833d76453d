#include "monitor/over_budget.h"

#include "common/number_text.h"

namespace sdf_ccd {

std::string overBudget(const Scene& scene) {
  if (!scene.max_error || scene.bound.total() <= *scene.max_error) return "";
  return "the error bound is " + lengthText(scene.bound.total()) + ", more than the max_error of " +
         lengthText(*scene.max_error) + ": " + lengthText(scene.bound.chord) + " of motions, " +
         lengthText(scene.bound.gap) + " of the triangles that stand for curved surfaces";
}

}  // namespace sdf_ccd
