#include "twist_lanes.h"

#include <cstddef>

#include "common/lane_vector.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

using Vector = LaneVector<Doubles>;

SDF_CCD_INLINE Doubles amounts(const Vector& v) {
  return absolute(v.x) + absolute(v.y) + absolute(v.z);
}

/// Three consecutive numbers of each body.
SDF_CCD_INLINE Vector gather(const std::array<const double*, kWidth>& from, int first) {
  const auto row = [&](int k) __attribute__((always_inline)) {
    return Doubles{from[0][k], from[1][k], from[2][k], from[3][k]};
  };
  return {row(first), row(first + 1), row(first + 2)};
}

struct Pose {
  Vector columns[3], translation;

  SDF_CCD_INLINE explicit Pose(const std::array<const double*, kWidth>& X)
      : columns{gather(X, 0), gather(X, 4), gather(X, 8)}, translation(gather(X, 12)) {}

  SDF_CCD_INLINE Vector operator*(const Vector& p) const {
    return columns[0] * p.x + columns[1] * p.y + columns[2] * p.z + translation;
  }

  /// Upper bound of |RᵀR − 1|, without a square root.
  SDF_CCD_INLINE Doubles defect() const {
    const auto product = [&](int i, int k) __attribute__((always_inline)) {
      return absolute(columns[i].dot(columns[k]) - (i == k ? 1.0 : 0.0));
    };
    return product(0, 0) + product(1, 1) + product(2, 2) + 2.0 * (product(0, 1) + product(1, 2) + product(2, 0));
  }
};

}  // namespace

SDF_CCD_LANES void computeTwists(const std::array<BodyStep, TwistLanes::kCount>& steps, TwistLanes& twists) {
  std::array<const double*, kWidth> starts, ends, balls;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    starts[i] = steps[i].start->data();
    ends[i] = steps[i].end->data();
    balls[i] = steps[i].ball->center.data();
  }
  const Pose start(starts), end(ends);
  const Vector center = gather(balls, 0);
  const Vector start_W = start * center, end_W = end * center, displacement = end_W - start_W;

  Vector cross{};  // 2 sin θ along the axis
  Doubles trace{};
  for (int k = 0; k < 3; ++k) {
    cross = cross + start.columns[k].cross(end.columns[k]);
    trace += start.columns[k].dot(end.columns[k]);
  }
  const Vector sine = cross * (Doubles{} + 0.5);
  const Doubles s2 = sine.dot(sine);
  const Vector omega = sine * (1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0 + s2 * (5.0 / 112.0))));

  store(end_W, twists.center_W);
  store(omega, twists.omega);
  lanes::store(squareRoot(omega.dot(omega)), twists.turn.data());
  store(displacement + omega.cross(omega.cross(displacement)) * (Doubles{} + 1.0 / 12.0), twists.velocity);
  store((start_W + end_W) * (Doubles{} + 0.5), twists.point_W);
  lanes::store(end.defect(), twists.defect.data());
  lanes::store(trace, twists.trace.data());
  lanes::store(squareRoot(displacement.dot(displacement)), twists.shift.data());
  lanes::store(amounts(start.translation) + amounts(end.translation) + amounts(center), twists.coordinates.data());
}

}  // namespace sdf_ccd
