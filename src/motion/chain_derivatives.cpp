#include "motion/chain_derivatives.h"

namespace sdf_ccd {
namespace {

/// With R = exp(q [a]): R' = q' [a] R, R'' = (q'' [a] + q'² [a]²) R,
/// R''' = (q''' [a] + 3 q' q'' [a]² + q'³ [a]³) R, and |[a]| = 1.
DerivativeSeries turnSeries(const DerivativeBounds& angle) {
  const double q1 = angle.first;
  return {1.0, q1, q1 * q1 + angle.second, q1 * q1 * q1 + 3.0 * q1 * angle.second + angle.third};
}

DerivativeSeries slideSeries(double reach, const DerivativeBounds& slide) {
  return {reach, slide.first, slide.second, slide.third};
}

}  // namespace

void ChainDerivatives::addFrame(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide) {
  series_ = turnSeries(angle) * series_ + slideSeries(reach, slide);
}

void ChainDerivatives::addInverse(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide) {
  series_ = turnSeries(angle) * (series_ + slideSeries(reach, slide));
}

DerivativeSeries DerivativeSeries::operator*(const DerivativeSeries& other) const {
  return {value * other.value, value * other.first + first * other.value,
          value * other.second + 2.0 * first * other.first + second * other.value,
          value * other.third + 3.0 * (first * other.second + second * other.first) + third * other.value};
}

DerivativeSeries DerivativeSeries::operator+(const DerivativeSeries& other) const {
  return {value + other.value, first + other.first, second + other.second, third + other.third};
}

CarriedDerivatives CarriedDerivatives::carrying(double reach, const DerivativeBounds& angle,
                                                const DerivativeBounds& slide) const {
  CarriedDerivatives result;
  result.turn_ = turn_ * turnSeries(angle);
  result.shift_ = turn_ * slideSeries(reach, slide) + shift_;
  return result;
}

CarriedDerivatives CarriedDerivatives::carryingInverse(double reach, const DerivativeBounds& angle,
                                                       const DerivativeBounds& slide) const {
  CarriedDerivatives result;
  result.turn_ = turn_ * turnSeries(angle);
  result.shift_ = result.turn_ * slideSeries(reach, slide) + shift_;
  return result;
}

}  // namespace sdf_ccd
