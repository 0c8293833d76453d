#pragma once

#include <cmath>
#include <optional>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// The normalised quaternion; none if its squared length is not 1 within 0.01, as in tf2, or not finite.
inline std::optional<Quaterniond> unitRotation(const Quaterniond& q) {
  constexpr double kMaxError = 1e-2;
  if (!(std::abs(q.squaredNorm() - 1.0) <= kMaxError)) return std::nullopt;
  return q.normalized();
}

}  // namespace sdf_ccd
