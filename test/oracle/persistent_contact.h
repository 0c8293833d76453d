#pragma once

#include <algorithm>
#include <cmath>

#include "oracle/bodies.h"

/// A contact that persists, in one dimension, simulated with the integrators under test: a point of mass 1 kg whose
/// weight presses it into a half-space, k = 10⁶ N/m, so that ω = 1000 rad/s.
namespace sdf_ccd::test {

constexpr double kOmega = 1000.0;  // [rad/s]

/// Whether a small oscillation about the resting depth does not grow. The point stays inside, so the system is linear.
inline bool staysStable(Scheme scheme, double zeta, double s, int steps) {
  RigidWorld world;
  world.bodies = {groundBody(), pointBody("point", 1.0)};
  world.contact.stiffness_per = StiffnessPer::kPoint;
  world.contact.stiffness = kOmega * kOmega;
  world.contact.damping = 2.0 * zeta * kOmega;
  const double rest = world.gravity.z() / world.contact.stiffness;  // m g / k below the surface
  const double start = 1e-3 * std::abs(rest);
  Simulation simulation(world, {at(Vector3d::Zero()), at({0.0, 0.0, rest + start})}, scheme, s / kOmega);
  double early = 0.0, late = 0.0;
  for (int i = 0; i < steps; ++i) {
    simulation.advance();
    const double amplitude = std::abs(simulation.states()[1].X_OB.translation().z() - rest);
    if (amplitude > 100.0 * start) return false;
    if (i >= steps / 4 && i < steps / 2) early = std::max(early, amplitude);
    if (i >= 3 * steps / 4) late = std::max(late, amplitude);
  }
  return late <= std::max(early, 1e-9 * start);
}

/// The largest stable s below `highest`, to a relative 1e-3 or better; all smaller ones are taken to be stable.
inline double largestStable(Scheme scheme, double zeta, double highest, int steps) {
  if (staysStable(scheme, zeta, highest, steps)) return highest;
  double low = 1e-3, high = highest;
  while (high > low * 1.001) {
    const double middle = std::sqrt(low * high);
    (staysStable(scheme, zeta, middle, steps) ? low : high) = middle;
  }
  return low;
}

/// Limit of s for the continuous scheme: s/4 < ζ < 1/s (design §3.10).
inline double continuousLimit(double zeta) {
  return std::min(4.0 * zeta, 1.0 / zeta);
}

/// Limit of s for the discrete scheme: s² + 4ζs < 4.
inline double discreteLimit(double zeta) {
  return 2.0 * (std::sqrt(zeta * zeta + 1.0) - zeta);
}

}  // namespace sdf_ccd::test
