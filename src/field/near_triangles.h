#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "grid_cell.h"
#include "surface_index.h"

namespace sdf_ccd {

/// Upper bound of the rounding of a distance from triangles near a cube, relative to it and the cube's size.
constexpr double kDistanceRounding = 1e-9;

/// A cube of space.
struct SpaceCube {
  Vector3d center;
  double side;

  double radius() const { return kHalfSqrt3 * side; }
  SpaceCube octant(int k) const {
    return {center + 0.25 * side * Vector3d((k & 1) ? 1.0 : -1.0, (k & 2) ? 1.0 : -1.0, (k & 4) ? 1.0 : -1.0),
            0.5 * side};
  }
  /// Corner k: bit 0 of k is x, bit 1 y, bit 2 z.
  Vector3d corner(int k) const { return octant(k).center + (octant(k).center - center); }
};

/// A cone of directions about an axis; `sine` is that of its half-angle. Sine 1: all directions.
struct DirectionCone {
  Vector3d axis = Vector3d::Zero();
  double sine = 1.0;
};

/// The triangles that can be the closest one to a point in a cube, and the signed distances to them.
class NearTriangles {
 public:
  NearTriangles() = default;

  /// @param distance  signed distance at the cube's centre [m].
  /// @param ids  the triangles, first the one nearest to the cube's centre; the array must outlive this.
  NearTriangles(const SurfaceIndex& surface, const SpaceCube& cube, double distance, const std::int32_t* ids,
                std::size_t count);

  /// Signed distance at a point of the cube.
  double signedDistance(const Vector3d& p) const;

  /// Signed distances at eight points of the cube, of which `count` are needed.
  void signedDistances(const PointLanes& points, int count, PointLanes::Lane& distances) const;

  /// Contains the gradient of the signed distance at all points of the cube where it is defined.
  const DirectionCone& gradientCone() const { return cone_; }

  /// The sign at a point of the cube if its closest triangles do not determine it.
  /// @param distance  of the point from the surface, unsigned [m].
  int signFarther(const Vector3d& p, double distance) const;

  const SurfaceIndex& surface() const { return *surface_; }
  const SpaceCube& cube() const { return cube_; }
  double centerDistance() const { return distance_; }
  std::size_t size() const { return count_; }
  std::int32_t triangle(std::size_t i) const { return ids_[i]; }

 private:
  /// The closest point, and the sign according to the triangles that contain it: 0 if they disagree.
  struct Closest {
    double distance;
    Vector3d point;
    int sign;
  };
  Closest closest(const Vector3d& p) const;
  void setCone();
  const Vector3d* setCone(Vector3d axis);

  const SurfaceIndex* surface_ = nullptr;
  SpaceCube cube_{};
  double distance_ = 0.0;
  const std::int32_t* ids_ = nullptr;
  std::size_t count_ = 0;
  DirectionCone cone_;
};

/// Computes the signed distances at points of a cube, eight at a time, and writes them to elements of an array.
template <class Value>
class DistanceWriter {
 public:
  DistanceWriter(const NearTriangles& near, Value* values) : near_(near), values_(values) {}
  ~DistanceWriter() { flush(); }
  DistanceWriter(const DistanceWriter&) = delete;
  DistanceWriter& operator=(const DistanceWriter&) = delete;

  /// @param index  of the array's element.
  void add(int index, const Vector3d& point) {
    indices_[count_] = index;
    points_.set(count_, point);
    if (++count_ == PointLanes::kCount) flush();
  }

 private:
  void flush() {
    if (count_ == 0) return;
    for (int k = count_; k < PointLanes::kCount; ++k) points_.copy(0, k);
    PointLanes::Lane distances;
    near_.signedDistances(points_, count_, distances);
    for (int k = 0; k < count_; ++k) values_[indices_[k]] = static_cast<Value>(distances[k]);
    count_ = 0;
  }

  const NearTriangles& near_;
  Value* values_;
  PointLanes points_;
  std::array<int, PointLanes::kCount> indices_;
  int count_ = 0;
};

}  // namespace sdf_ccd
