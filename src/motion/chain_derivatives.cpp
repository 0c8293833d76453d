#include "motion/chain_derivatives.h"

namespace sdf_ccd {

void ChainDerivatives::addFrame(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide) {
  turnBy(angle);
  slideBy(reach, slide);
}

void ChainDerivatives::addInverse(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide) {
  slideBy(reach, slide);
  turnBy(angle);
}

void ChainDerivatives::slideBy(double reach, const DerivativeBounds& slide) {
  distance_ += reach;
  first_ += slide.first;
  second_ += slide.second;
  third_ += slide.third;
}

/// With R = exp(q [a]): R' = q' [a] R, R'' = (q'' [a] + q'² [a]²) R, R''' = (q''' [a] + 3 q' q'' [a]² + q'³ [a]³) R,
/// and
/// |[a]| = 1; then Leibniz' rule for R x.
void ChainDerivatives::turnBy(const DerivativeBounds& angle) {
  const double q1 = angle.first;
  const double r1 = q1, r2 = q1 * q1 + angle.second, r3 = q1 * q1 * q1 + 3.0 * q1 * angle.second + angle.third;
  third_ += 3.0 * r1 * second_ + 3.0 * r2 * first_ + r3 * distance_;
  second_ += 2.0 * r1 * first_ + r2 * distance_;
  first_ += r1 * distance_;
}

}  // namespace sdf_ccd
