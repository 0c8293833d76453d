#pragma once

#include <cstdint>
#include <vector>

#include "sdf_ccd/geometry/triangle.h"
#include "signed_surface.h"

namespace sdf_ccd {

/// A mesh prepared for many questions about small regions of space.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(const TriangleMesh& mesh);

  struct Triangle {
    MeasuredTriangle shape;
    Vector3d normal;  ///< of length one
    bool separates;   ///< see separatingTriangles()
  };

  const SignedSurface& exact() const { return exact_; }
  const Triangle& triangle(int i) const { return triangles_[static_cast<std::size_t>(i)]; }

 private:
  SignedSurface exact_;
  std::vector<Triangle> triangles_;
};

/// A ball of space.
struct Ball {
  Vector3d center;
  double radius;
};

/// A cone of directions: those within the half-angle whose sine this is from the axis. Sine 1: all directions.
struct DirectionCone {
  Vector3d axis = Vector3d::Zero();
  double sine = 1.0;
};

/// The triangles that can be the closest one to a place in a ball, and the signed distances they give there.
class NearTriangles {
 public:
  /// @param distance  of the surface from the ball's centre, signed [m].
  NearTriangles(const SurfaceIndex& surface, const Ball& ball, double distance);

  /// For a ball within another one.
  NearTriangles(const NearTriangles& around, const Ball& ball, double distance);

  /// Signed distance at a place of the ball.
  double signedDistance(const Vector3d& p) const;

  /// Holds the gradient of the signed distance wherever it is defined in a ball within this one.
  DirectionCone gradientCone(const Ball& ball) const;

  std::size_t size() const { return entries_.size(); }

  double centerDistance() const { return distance_; }

 private:
  struct Entry {
    double distance;  ///< of the triangle from the centre [m]
    std::int32_t triangle;
  };

  void sortAndSetCone();
  /// The closest place, and what the triangles that hold it say of the sign: 0 if they do not agree.
  struct Closest {
    double distance;
    Vector3d point;
    int sign;
  };
  Closest closest(const Vector3d& p) const;
  DirectionCone coneOf(const std::vector<Entry>& entries) const;

  const SurfaceIndex& surface_;
  Ball ball_;
  double distance_;
  std::vector<Entry> entries_;  ///< nearest to the centre first
  DirectionCone cone_;
};

}  // namespace sdf_ccd
