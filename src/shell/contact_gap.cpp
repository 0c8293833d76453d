#include "shell/contact_gap.h"

#include <algorithm>

#include "shell/point_shell.h"

namespace sdf_ccd {

double contactGap(const PointShell& a, const PointShell& b) {
  const double covering = std::min(a.covering_radius, b.covering_radius);
  return std::min(covering, std::max(a.edge_radius, b.edge_radius) + 2.0 * (a.flatness + b.flatness));
}

double contactGapToPlane(const PointShell& a) {
  return std::min(a.covering_radius, a.edge_radius + 2.0 * a.flatness);
}

}  // namespace sdf_ccd
