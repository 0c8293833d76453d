#pragma once

#include <variant>

#include "sdf_ccd/mesh.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// All points within the radius of the origin.
struct Sphere {
  double radius = 0.0;  ///< [m], about the origin
};

/// A cuboid about the origin with edges along the axes. Made by name, because braces do not say whether they hold full
/// sizes, as in URDF, or halves.
struct Box {
  Vector3d size = Vector3d::Zero();  ///< full lengths of the edges [m]

  /// From the full lengths of the edges [m].
  static Box fromSize(const Vector3d& size) {
    Box box;
    box.size = size;
    return box;
  }

  /// Of the corner in the positive octant [m].
  Vector3d halfSize() const { return 0.5 * size; }

 private:
  explicit Box() = default;  // no aggregate
};

/// A solid circular cylinder around z, about the origin. Made by name, as a Box.
struct Cylinder {
  double radius = 0.0;  ///< [m]
  double length = 0.0;  ///< full length along z [m]

  /// From the radius and the full length [m].
  static Cylinder fromRadiusAndLength(double radius, double length) {
    Cylinder cylinder;
    cylinder.radius = radius;
    cylinder.length = length;
    return cylinder;
  }

  /// From the origin to either end [m].
  double halfLength() const { return 0.5 * length; }

 private:
  explicit Cylinder() = default;
};

/// All points with normal·p ≤ offset: the ground is {(0,0,1), 0}.
struct HalfSpace {
  Vector3d normal = Vector3d::UnitZ();  ///< points out of the solid, unit
  double offset = 0.0;                  ///< [m]
};

/// A convex solid with an exact signed distance.
using Primitive = std::variant<Sphere, Box, Cylinder, HalfSpace>;

/// A half-space is the only primitive that is unbounded, and so has no shell.
inline bool isHalfSpace(const Primitive& primitive) {
  return std::holds_alternative<HalfSpace>(primitive);
}

/// Throws std::invalid_argument, with the value, unless all sizes are finite and positive and normals are unit.
void validate(const Primitive& primitive);

/// Exact signed distance [m], negative inside. Convex in p (the solid is convex), so it is convex along any line.
double signedDistance(const Primitive& primitive, const Vector3d& p);

/// Gradient of the signed distance: unit, pointing out. Where the closest point is not unique (a sphere's centre),
/// one of the valid directions.
Vector3d distanceGradient(const Primitive& primitive, const Vector3d& p);

/// Box around the solid; infinite for a half-space.
AlignedBox3d boundingBox(const Primitive& primitive);

/// Area of the surface [m²]; infinite for a half-space.
double surfaceArea(const Primitive& primitive);

/// Closed mesh with vertices on the surface, nowhere farther than `max_deviation` [m] from it.
/// @throws std::invalid_argument for a half-space, which is unbounded.
TriangleMesh tessellate(const Primitive& primitive, double max_deviation);

}  // namespace sdf_ccd
