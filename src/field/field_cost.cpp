#include "field/field_cost.h"

#include <algorithm>

#include "field/opening_caps.h"
#include "field/uniform/sparse_grid.h"
#include "grid_cell.h"

namespace sdf_ccd {
namespace {

/// Memory of the caps that the field stores [bytes]; see wideCaps() in build_field.cpp.
double capBytes(const Openings& openings, double error) {
  const auto kept =
      std::count_if(openings.reach.begin(), openings.reach.end(), [&](double r) { return r > kNarrowCap * error; });
  return double(kept) * double(3 * sizeof(Vector3d) + sizeof(Vector3i) + sizeof(double));
}

}  // namespace

FieldCost expectedCost(const ClosedSolid& closed, const FieldOptions& given) {
  const FieldOptions options = withResolution(given);
  FieldCost cost =
      options.max_error ? expectedAdaptive(closed.solid(), options) : expectedUniform(closed.solid(), options);
  const double cells = options.cells.value_or(1);
  const double size = boundingBox(closed.solid().boundary()).sizes().maxCoeff();
  cost.bytes +=
      capBytes(closed.openings(), options.max_error.value_or(kHalfSqrt3 * options.cell_size.value_or(size / cells)));
  return cost;
}

}  // namespace sdf_ccd
