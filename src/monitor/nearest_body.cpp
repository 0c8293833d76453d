#include <algorithm>
#include <limits>

#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {

NearestBody nearestBody(const Scene& scene, const std::vector<Isometry3d>& X_WB, const Vector3d& p_W) {
  NearestBody nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  double low = nearest.distance;  // lower bound of all distances
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (!scene.bodies[b].failure.empty()) continue;
    const Matrix3d& R_WB = X_WB[b].linear();
    const Vector3d p_B = R_WB.transpose() * (p_W - X_WB[b].translation());
    for (const BodyPart& part : scene.bodies[b].parts) {
      const Vector3d p_G = part.X_BG.inverse() * p_B;
      if (part.field.lowerBound(p_G) > nearest.distance) continue;
      const FieldSample sample = part.field.meshSample(p_G);
      low = std::min(low, sample.value - sample.error);
      if (sample.value >= nearest.distance) continue;
      nearest = {static_cast<int>(b), sample.value, sample.error, R_WB * (part.X_BG.linear() * sample.gradient)};
    }
  }
  if (nearest.body < 0) return {};
  // Another body with a larger error may in truth be nearer.
  nearest.error = std::max(nearest.error, nearest.distance - low);
  return nearest;
}

}  // namespace sdf_ccd
