#include "primitive_spheres.h"

#include <limits>

#include "common/lane_vector.h"
#include "query/swept_side.h"

namespace sdf_ccd {
namespace {

using namespace lanes;
using Vectors = LaneVector<Doubles>;
using Sweep = PrimitiveSpheres::Sweep;

/// Signed distance to the region where neither coordinate is positive, as signedDistance().
SDF_CCD_INLINE Doubles cornerDistance(const Doubles& x, const Doubles& y) {
  const Doubles zero = {}, out_x = larger(x, zero), out_y = larger(y, zero);
  return squareRoot(out_x * out_x + out_y * out_y) + smaller(larger(x, y), zero);
}

SDF_CCD_INLINE Doubles distance(const Sphere& sphere, const Vectors& p) {
  return squareRoot(p.dot(p)) - sphere.radius;
}

SDF_CCD_INLINE Doubles distance(const Box& box, const Vectors& p) {
  const Doubles zero = {};
  const Vector3d half = box.halfSize();
  const Vectors q{absolute(p.x) - half[0], absolute(p.y) - half[1], absolute(p.z) - half[2]};
  const Vectors out{larger(q.x, zero), larger(q.y, zero), larger(q.z, zero)};
  return squareRoot(out.dot(out)) + smaller(larger(q.x, larger(q.y, q.z)), zero);
}

SDF_CCD_INLINE Doubles distance(const Cylinder& cylinder, const Vectors& p) {
  return cornerDistance(squareRoot(p.x * p.x + p.y * p.y) - cylinder.radius, absolute(p.z) - cylinder.halfLength());
}

SDF_CCD_INLINE Doubles distance(const HalfSpace& half_space, const Vectors& p) {
  const Vector3d& n = half_space.normal;
  return p.x * n[0] + p.y * n[1] + p.z * n[2] - half_space.offset;
}

SDF_CCD_INLINE Vectors transformed(const Isometry3d& X, const Vectors& p) {
  const auto row = [&](int i) __attribute__((always_inline)) {
    return p.x * X(i, 0) + p.y * X(i, 1) + p.z * X(i, 2) + X(i, 3);
  };
  return {row(0), row(1), row(2)};
}

SDF_CCD_INLINE Doubles fromFloats(const float* at) {
  return Doubles{at[0], at[1], at[2], at[3]};
}

template <class Shape>
SDF_CCD_INLINE void testSpheresOf(const Shape& shape, const Sweep& sweep, SphereGroup& group) {
  static_assert(RayQueue::kSlack >= kWidth, "whole vectors are read and written");
  for (int i = 0; i < group.size; i += kWidth) {
    const Vectors p{fromFloats(group.center[0].data() + i), fromFloats(group.center[1].data() + i),
                    fromFloats(group.center[2].data() + i)};
    const Doubles radius = fromFloats(group.radius.data() + i);
    const Vectors start = transformed(sweep.start, p), end = transformed(sweep.end, p), d = end - start;
    const Doubles at_start = distance(shape, start), at_middle = distance(shape, start + d * (Doubles{} + 0.5)),
                  at_end = distance(shape, end), half = 0.5 * squareRoot(d.dot(d));
    // The solid is convex, so the distance is greatest at an end. It is 1-Lipschitz, so on each half of the path it is
    // nowhere less than half of what is left of both ends' distances when the half has been gone.
    const auto inside = larger(at_start, at_end) + radius + sweep.margin < Doubles{};
    const auto outside = 0.5 * (at_middle + smaller(at_start, at_end) - half) - radius - sweep.margin > Doubles{};
    for (int k = 0; k < kWidth; ++k) {
      group.side[i + k] = static_cast<std::int32_t>(inside[k]    ? SweptSide::kInside
                                                    : outside[k] ? SweptSide::kOutside
                                                                 : SweptSide::kUnknown);
    }
  }
}

SDF_CCD_LANES void testSpheres(const Sphere& shape, const Sweep& sweep, SphereGroup& group) {
  testSpheresOf(shape, sweep, group);
}
SDF_CCD_LANES void testSpheres(const Box& shape, const Sweep& sweep, SphereGroup& group) {
  testSpheresOf(shape, sweep, group);
}
SDF_CCD_LANES void testSpheres(const Cylinder& shape, const Sweep& sweep, SphereGroup& group) {
  testSpheresOf(shape, sweep, group);
}
SDF_CCD_LANES void testSpheres(const HalfSpace& shape, const Sweep& sweep, SphereGroup& group) {
  testSpheresOf(shape, sweep, group);
}

/// Upper bound of the error of the distances in test() [m]. A group's coordinates are rounded to single precision: by
/// 2^-24 of the largest one each, which is √3 2^-24 < 2^-23 in length. In double precision, coordinates that are added
/// up are nowhere larger than the poses' and the points' together; a dozen roundings follow.
double roundingOf(const Primitive& primitive, const Chord& chord, const BoundingBall& shell) {
  const double size = shell.center.norm() + shell.radius;
  const HalfSpace* plane = std::get_if<HalfSpace>(&primitive);
  // Not finite if a pose is not, so that nothing is known then.
  const double places = chord.X_FP_start.matrix().norm() + chord.X_FP_end.matrix().norm() + size +
                        (plane ? std::abs(plane->offset) : 0.0);
  return std::numeric_limits<float>::epsilon() * size + 32.0 * std::numeric_limits<double>::epsilon() * places;
}

}  // namespace

PrimitiveSpheres::PrimitiveSpheres(const Primitive& primitive, const Chord& chord, double margin,
                                   const BoundingBall& shell)
    : primitive_(primitive), sweep_{chord.X_FP_start, chord.X_FP_end, margin + roundingOf(primitive, chord, shell)} {}

void PrimitiveSpheres::test(SphereGroup& group) const {
  std::visit([&](const auto& shape) { testSpheres(shape, sweep_, group); }, primitive_);
}

}  // namespace sdf_ccd
