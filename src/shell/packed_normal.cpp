#include "shell/point_shell.h"

namespace sdf_ccd {

PackedNormal::PackedNormal(const Vector3d& n) {
  const double sum = n.lpNorm<1>();
  if (!(sum > 0.0) || !std::isfinite(sum)) return;
  const double x = n.x() / sum, y = n.y() / sum;
  const bool is_lower = n.z() < 0.0;
  const auto rounded = [](double coordinate) { return static_cast<std::int16_t>(std::lround(32767.0 * coordinate)); };
  u = rounded(is_lower ? std::copysign(1.0 - std::abs(y), x) : x);
  v = rounded(is_lower ? std::copysign(1.0 - std::abs(x), y) : y);
}

}  // namespace sdf_ccd
