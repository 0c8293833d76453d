#pragma once

#include <cmath>
#include <memory>
#include <variant>
#include <vector>

#include "common/infinity.h"
#include "sdf_ccd/primitive.h"
#include "sdf_ccd/types.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd {

/// The depth of one point [m].
struct PointDepth {
  double depth = -kInfinity;        ///< negative outside: minus the distance
  int triangle = -1;                ///< of the solid's boundary, the nearest one; -1 where there are none
  Vector3d out = Vector3d::Zero();  ///< unit: the outward normal at the nearest point of the surface
};

/// A plane that bounds depths: a point x within the ball is no deeper than offset − normal·x, if the ball also contains
/// the ball about x that touches the plane. So depths of points in front of the plane are bounded as well, which are
/// negative: what is nearer than the plane would lie in the ball.
struct DepthPlane {
  Vector3d normal = Vector3d::Zero();  ///< unit
  double offset = 0.0;
  Vector3d center = Vector3d::Zero();  ///< of the ball
  double radius = -kInfinity;          ///< infinite: everywhere

  double depthBehind(const Vector3d& x) const { return offset - normal.dot(x); }

  bool holdsAt(const Vector3d& x) const {
    return radius == kInfinity || (x - center).norm() + std::abs(depthBehind(x)) <= radius;
  }
};

/// A body's solid, in which depths are measured: all its elements as one, so that where they meet it is as deep as the
/// whole. In its own frame G, which may differ from the body's, as bodies share the solids of meshes.
class DepthSolid {
 public:
  /// @param solid      must be closed.
  /// @param deviation  upper bound of its surface's from the body's [m].
  /// @param inner      contained in the body, as the solid contains it; null if the solid's deviation tells as much.
  /// The depth in a union is not within its surface's deviation: where elements just meet, it may be far greater.
  DepthSolid(std::shared_ptr<const Solid> solid, const Isometry3d& X_BG, double deviation = 0.0,
             std::shared_ptr<const Solid> inner = nullptr);
  DepthSolid(const Sphere& ball, const Isometry3d& X_BG) : X_BG_(X_BG), shape_(ball) {}
  DepthSolid(const HalfSpace& half_space) : shape_(half_space) {}

  const Isometry3d& X_BG() const { return X_BG_; }
  double deviation() const { return deviation_; }

  /// @param likely  a triangle that is probably near, or -1; it does not affect the depth.
  PointDepth at(const Vector3d& p, int likely = -1) const;

  /// Lower bound of the depth in the body, up to the deviation, of a point that is this deep in the solid [m].
  double leastDepth(const Vector3d& p, double depth) const;

  /// Upper bound of all depths [m]: no ball in the solid is larger.
  double greatestDepth() const;

  /// Of a ball; 0 for another solid [m].
  double radius() const;

  /// Lower bound of the distance of a point, negative inside, where it takes no search; else −∞.
  double distanceBound(const Vector3d& p) const;

  /// A plane with this normal, near the surface in front of the ball, that bounds depths in the ball and around it; one
  /// without a radius if there is none.
  /// @param triangle  whose normal it is; -1 for none.
  /// @param depth     of the ball's center [m].
  DepthPlane planeAlong(const Vector3d& normal, int triangle, const Vector3d& center, double size,
                        const PointDepth& depth) const;

  /// The normal of a triangle of the boundary; zero for a degenerate one.
  Vector3d normalOf(int triangle) const;

  /// Distance from a triangle of the boundary [m]: no depth exceeds it.
  double distanceTo(int triangle, const Vector3d& p) const { return mesh().solid->tree().distanceTo(triangle, p); }

  std::size_t bytes() const;

 private:
  struct Mesh {
    std::shared_ptr<const Solid> solid;
    AlignedBox3d box;
    std::vector<double> protrusion;  ///< per triangle: how far the solid extends beyond its plane [m]
  };

  const Mesh& mesh() const { return std::get<Mesh>(shape_); }

  Isometry3d X_BG_ = Isometry3d::Identity();
  double deviation_ = 0.0;
  std::variant<Mesh, Sphere, HalfSpace> shape_;
  std::shared_ptr<const Solid> inner_;
};

}  // namespace sdf_ccd
