#include "field/opening_caps.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/number_text.h"

namespace sdf_ccd {

OpeningCaps::OpeningCaps(TriangleMesh mesh, std::vector<double> reach)
    : mesh_(std::move(mesh)), reach_(std::move(reach)), tree_(mesh_) {
  if (reach_.size() != mesh_.triangles.size()) {
    throw std::invalid_argument("caps: " + std::to_string(reach_.size()) + " reaches for " +
                                std::to_string(mesh_.triangles.size()) + " triangles");
  }
  for (const double reach : reach_) {
    if (!(reach >= 0.0) || !std::isfinite(reach)) {
      throw std::invalid_argument("caps: invalid reach " + numberText(reach) + " m");
    }
  }
}

double OpeningCaps::meshDistanceBound(const Vector3d& p_F) const {
  const TriangleTree::ClosestPoint nearest = tree_.closestPoint(p_F);
  return nearest.distance + reach_[static_cast<std::size_t>(nearest.triangle)];
}

std::size_t OpeningCaps::bytes() const {
  return mesh_.vertices.size() * sizeof(Vector3d) + mesh_.triangles.size() * (sizeof(Vector3i) + sizeof(double));
}

FieldSample overMesh(FieldSample of_closed, const OpeningCaps& caps, const Vector3d& p_F) {
  // The mesh is at least as far as the closed surface. It is at most as far, too, unless a cap may contain the nearest
  // point: then the upper bound is the length of the path through the nearest cap.
  const double near = std::abs(of_closed.value) + of_closed.error;
  const bool by_cap = caps.isWithin(p_F, near);
  const double far = by_cap ? std::max(near, caps.meshDistanceBound(p_F)) : near;
  if (of_closed.value < 0.0 || (by_cap && of_closed.value < of_closed.error)) {
    of_closed.error = far + std::abs(of_closed.value);  // the point may be on either side
  } else if (by_cap) {
    of_closed.error = far - of_closed.value;
  }
  return of_closed;
}

}  // namespace sdf_ccd
