#include "print.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/number_text.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "field/opening_caps.h"
#include "field/uniform/sparse_grid.h"
#include "shell/point_shell.h"

namespace sdf_ccd::tools {

std::string describe(const AlignedBox3d& box) {
  return vectorText(box.min()) + " .. " + vectorText(box.max()) + " m";
}

std::string describe(const DistanceField& field) {
  const std::string accuracy = fmt::format("{}, error at most {:.3g} m within {:.3g} m of the surface",
                                           memoryText(double(field.bytes())), field.errorBound(), field.band());
  if (const AdaptiveGrid* adaptive = FieldAccess::adaptive(field)) {
    const Vector3i size = adaptive->shape().size;
    return fmt::format("{}×{}×{} cells of {:.4g} m, divided into {} where needed, ", size.x(), size.y(), size.z(),
                       adaptive->shape().cell, field.cells()) +
           accuracy;
  }
  const Vector3i cells = FieldAccess::grid(field)->shape().cells();
  return fmt::format("{}×{}×{} cells of {:.4g} m, {} of them stored, ", cells.x(), cells.y(), cells.z(),
                     FieldAccess::grid(field)->shape().cell, field.cells()) +
         accuracy;
}

std::string describeOpenings(const DistanceField& field) {
  const OpeningCaps* caps = FieldAccess::openings(field);
  if (!caps) return "none";
  const double reach = *std::max_element(caps->reach().begin(), caps->reach().end());
  return fmt::format(
      "caps of {:.3g} m^2 that reach up to {:.3g} m from the mesh: points enclosed only by caps may be inside or "
      "outside",
      surfaceArea(caps->mesh()), reach);
}

std::string describe(const PointShell& shell) {
  return fmt::format("{} points, no point of the surface farther than {:.3g} m from one", shell.size(),
                     shell.covering_radius);
}

}  // namespace sdf_ccd::tools
