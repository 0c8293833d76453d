#pragma once

namespace sdf_ccd {

/// Relative weight of the impulse that one shell of a pair finds in the other body's field, among the shells of the
/// pair (design §3.7): equal, except for shells whose spacing is more than three times the finest. The error of a
/// wrench comes from how few points touch, so such points count ever less, by the square of their number per area;
/// without a jump, so that nearly equal bodies give nearly equal forces.
/// @param spacing  PointShell::covering_radius [m].
/// @param finest   the least of all shells of the pair [m]; if it is zero (points without a surface), all weigh the
/// same.
double roleWeight(double spacing, double finest);

}  // namespace sdf_ccd
