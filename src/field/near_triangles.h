#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "../geometry/triangle_lanes.h"
#include "field/uniform/sparse_grid.h"
#include "geometry/triangle.h"
#include "signed_surface.h"

namespace sdf_ccd {

/// The boundary of a mesh's solid, prepared for many queries in small regions of space.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(const TriangleMesh& mesh) : SurfaceIndex(Solid(mesh)) {}
  explicit SurfaceIndex(Solid solid);

  /// A triangle's contribution to the sign of the distance.
  struct Face {
    Vector3d normal;  ///< of length one
    bool separates;   ///< see Solid::separates()
    bool sliver;
  };

  const SignedSurface& exact() const { return exact_; }
  /// The largest squared distance that ties with this one, as those of triangles with a common closest edge do.
  double tie2(double closest2) const {
    const double closest = std::sqrt(closest2) + exact_.solid().seam();
    return closest * closest * (1.0 + kTie);
  }
  const MeasuredTriangle& triangle(int i) const { return triangles_[static_cast<std::size_t>(i)]; }
  const Face& face(int i) const { return faces_[static_cast<std::size_t>(i)]; }

  /// As the functions of triangle_lanes.h, but for slivers too.
  void offer(int i, const Vector3d& axis, const PointLanes& points, ClosestLanes& closest) const;
  void ways(int i, const PointLanes& points, DisplacementLanes& ways) const;

 private:
  /// Relative rounding of squared distances, which is largest for slivers. A false tie costs little: if the triangles
  /// then disagree about the sign, the centre's sign decides.
  static constexpr double kTie = 1e-9;

  SignedSurface exact_;
  std::vector<MeasuredTriangle> triangles_;
  std::vector<Face> faces_;
  std::vector<FlatTriangle> flat_;
};

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

/// The triangles near a cube, from a search over all triangles.
class NearCube {
 public:
  /// @param nearest  the triangle nearest to the cube's centre, and its distance.
  NearCube(const SurfaceIndex& surface, const SpaceCube& cube, const SignedSurface::Nearest& nearest);

  const NearTriangles& near() const { return near_; }

 private:
  std::vector<std::int32_t> ids_;
  NearTriangles near_;
};

/// The triangles near each octant of a cube; octants are ordered like corners. A list is made when it is first needed.
class NearOctants {
 public:
  explicit NearOctants(const NearTriangles& around);
  NearOctants(const NearOctants&) = delete;
  NearOctants& operator=(const NearOctants&) = delete;

  /// Signed distance at the octant's centre [m].
  double centerDistance(int k) const { return distances_[k]; }
  SignedSurface::Nearest nearest(int k) const { return {distances_[k], nearest_[k]}; }

  const NearTriangles& operator[](int k);

 private:
  int sign(int k, std::size_t nearest) const;

  /// Memory for `per_triangle` elements for each triangle; inline if there are few triangles, which is usual.
  template <class T, std::size_t per_triangle>
  class Room {
   public:
    explicit Room(std::size_t triangles) : many_(triangles > kFew ? new T[triangles * per_triangle] : nullptr) {}

    T* get() { return many_ ? many_.get() : few_.data(); }
    const T* get() const { return many_ ? many_.get() : few_.data(); }

   private:
    static constexpr std::size_t kFew = 12;

    std::array<T, kFew * per_triangle> few_;
    std::unique_ptr<T[]> many_;
  };

  const NearTriangles& around_;
  Room<DisplacementLanes, 1> ways_;      ///< per triangle: displacements from it to the octants' centres
  Room<std::int32_t, 8> ids_;            ///< per octant: a list with room for all triangles
  std::array<std::int32_t, 8> nearest_;  ///< the triangle nearest to each octant's centre
  std::array<double, 8> distances_;
  std::array<NearTriangles, 8> near_;
};

}  // namespace sdf_ccd
