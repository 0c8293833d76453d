#include "signed_surface.h"

#include <cmath>

namespace sdf_ccd {

SignedSurface::SignedSurface(const TriangleMesh& mesh) : tree_(mesh), closed_(isClosed(mesh)) {}

double SignedSurface::signedDistance(const Vector3d& p) const {
  const double d = tree_.closestPoint(p).distance;
  return inside(p) ? -d : d;
}

double SignedSurface::nextDistance(const Vector3d& p, double last, double step) const {
  const double d = tree_.closestPoint(p, (std::abs(last) + step) * (1.0 + 1e-9)).distance;
  if (closed_ && d + std::abs(last) > step * (1.0 + 1e-9)) return last < 0.0 ? -d : d;
  return inside(p) ? -d : d;
}

}  // namespace sdf_ccd
