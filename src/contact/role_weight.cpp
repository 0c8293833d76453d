#include "contact/role_weight.h"

#include <algorithm>
#include <cmath>

namespace sdf_ccd {

double roleWeight(double spacing, double finest) {
  constexpr double kAlike = 3.0;  // within which spacings by the sizes of elements mostly are
  if (!(finest > 0.0)) return 1.0;
  return std::pow(std::max(1.0, spacing / (kAlike * finest)), -4.0);
}

}  // namespace sdf_ccd
