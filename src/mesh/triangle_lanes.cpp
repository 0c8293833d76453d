#include "triangle_lanes.h"

#include <cmath>

#include "common/compiler_lanes.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

SDF_CCD_INLINE Doubles clamped(const Doubles& t, double most) {
  const Doubles zero = {};
  return smaller(larger(t, zero), zero + most);
}

/// The displacement from the closest point to the query point: in the triangle's plane, and along its normal.
struct Displacement {
  Doubles u, v, normal;

  SDF_CCD_INLINE Doubles squared() const { return u * u + v * v + normal * normal; }
};

/// In the plane, from the nearest of the edges' closest points; zero if the query point projects into the triangle.
SDF_CCD_INLINE Displacement displacementTo(const FlatTriangle& t, const PointLanes& points, int k) {
  const Doubles x = load(points.x.data() + k) - t.origin[0], y = load(points.y.data() + k) - t.origin[1],
                z = load(points.z.data() + k) - t.origin[2];
  const Doubles u = t.u[0] * x + t.u[1] * y + t.u[2] * z;
  const Doubles v = t.v[0] * x + t.v[1] * y + t.v[2] * z;
  const Doubles zero = {};

  Doubles best_u = u - clamped(u, t.b), best_v = v, best2 = best_u * best_u + v * v;
  const auto take = [&](const Doubles& other_u, const Doubles& other_v) __attribute__((always_inline)) {
    const Doubles other2 = other_u * other_u + other_v * other_v;
    best_u = other2 < best2 ? other_u : best_u;
    best_v = other2 < best2 ? other_v : best_v;
    best2 = other2 < best2 ? other2 : best2;
  };
  const double edge = t.c - t.b;
  const Doubles w = u - t.b;
  const Doubles on_bc = clamped((w * edge + v * t.height) * t.inverse_bc2, 1.0);
  take(w - on_bc * edge, v - on_bc * t.height);
  const Doubles on_ca = clamped((u * t.c + v * t.height) * t.inverse_ca2, 1.0);
  take(u - on_ca * t.c, v - on_ca * t.height);

  // The least of the heights over the three edges (times their lengths).
  const Doubles over_bc = edge * v - t.height * w, over_ca = t.height * u - t.c * v;
  const Doubles over = smaller(smaller(v, over_bc), over_ca);
  return {over < zero ? best_u : zero, over < zero ? best_v : zero,
          t.normal[0] * x + t.normal[1] * y + t.normal[2] * z};
}

}  // namespace

FlatTriangle::FlatTriangle(const Corners& corners) {
  const Vector3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const Vector3d e1 = ab.normalized(), e3 = ab.cross(ac).normalized(), e2 = e3.cross(e1).normalized();
  for (int k = 0; k < 3; ++k) {
    origin[k] = corners[0][k];
    u[k] = e1[k];
    v[k] = e2[k];
    normal[k] = e3[k];
  }
  b = ab.norm();
  c = ac.dot(e1);
  height = ac.dot(e2);
  inverse_bc2 = 1.0 / ((c - b) * (c - b) + height * height);
  inverse_ca2 = 1.0 / (c * c + height * height);
}

SDF_CCD_LANES void offer(const FlatTriangle& t, const Vector3d& axis, const PointLanes& points, ClosestLanes& closest) {
  const double au = t.u[0] * axis[0] + t.u[1] * axis[1] + t.u[2] * axis[2];
  const double av = t.v[0] * axis[0] + t.v[1] * axis[1] + t.v[2] * axis[2];
  const double an = t.normal[0] * axis[0] + t.normal[1] * axis[1] + t.normal[2] * axis[2];
  for (int k = 0; k < PointLanes::kCount; k += kWidth) {
    const Displacement displacement = displacementTo(t, points, k);
    const Doubles distance2 = displacement.squared(), held2 = load(closest.distance2.data() + k);
    const Doubles side = displacement.u * au + displacement.v * av + displacement.normal * an,
                  held = load(closest.side.data() + k);
    store(distance2 < held2 ? side : held, closest.side.data() + k);
    store(distance2 < held2 ? distance2 : held2, closest.distance2.data() + k);
  }
}

SDF_CCD_LANES void displacements(const FlatTriangle& t, const PointLanes& points, DisplacementLanes& found) {
  for (int k = 0; k < PointLanes::kCount; k += kWidth) {
    const Displacement displacement = displacementTo(t, points, k);
    store(displacement.squared(), found.distance2.data() + k);
    store(displacement.u * t.u[0] + displacement.v * t.v[0] + displacement.normal * t.normal[0], found.x.data() + k);
    store(displacement.u * t.u[1] + displacement.v * t.v[1] + displacement.normal * t.normal[1], found.y.data() + k);
    store(displacement.u * t.u[2] + displacement.v * t.v[2] + displacement.normal * t.normal[2], found.z.data() + k);
  }
}

}  // namespace sdf_ccd
