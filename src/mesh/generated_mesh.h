#pragma once

#include <vector>

#include "sdf_ccd/mesh.h"

/// Closed meshes made from numbers, for scenes and studies that need shapes beyond the primitives. Sizes are metres;
/// all throw std::invalid_argument for sizes that are not finite and positive, or counts that give no solid.
namespace sdf_ccd {

/// Surface over rings of equally many points each, in order; a ring of one point is a pole. The ends are closed by
/// fans, or joined to each other if `loop`. Oriented so that it encloses positive volume.
TriangleMesh lofted(const std::vector<std::vector<Vector3d>>& rings, bool loop = false);

/// Prism over a simple polygon in x and y, |z| ≤ height / 2.
TriangleMesh extruded(const std::vector<Vector3d>& outline, double height);

/// Half a hollow sphere, open at the top, with a rounded rim. Concave: two of them nest.
TriangleMesh bowlMesh(double radius, double thickness, int steps);

/// A sphere with bumps and dents of `bump` times its radius; about `points` vertices.
TriangleMesh blobMesh(double radius, double bump, int points);

/// A spinning top that stands on its rounded tip: a cone with a stem, its tip at the lowest point.
TriangleMesh topMesh(double radius, double height, int steps);

/// A cone about z with its tip at z = height / 2 and its base at −height / 2. The mesh contains the cone, and exceeds
/// it by at most kConeExcess times the radius.
TriangleMesh coneMesh(double radius, double height);
constexpr double kConeExcess = 1e-4;

/// A triangular prism with an edge at the bottom: `width` across at the top, `height` deep, `length` along y.
TriangleMesh wedgeMesh(double width, double height, double length);

/// A block of twice a wedge's width with a slot that fits the wedge, open at the top.
TriangleMesh slotMesh(double width, double height, double length);

/// A right-handed thread about z with a rounded profile.
struct Thread {
  double radius;  ///< outer [m]
  double pitch;   ///< [m] per revolution
  double depth;   ///< outer less inner radius [m]
};

/// A rod with an external thread, |z| ≤ length / 2.
TriangleMesh boltMesh(const Thread& thread, double length, int steps);

/// A hexagon with an internal thread, widened by `clearance` [m], |z| ≤ height / 2.
TriangleMesh nutMesh(const Thread& thread, double clearance, double height, int steps);

}  // namespace sdf_ccd
