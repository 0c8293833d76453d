#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "near_triangles.h"

namespace sdf_ccd {

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
  Room<DisplacementLanes, 1> displacements_;  ///< per triangle: displacements from it to the octants' centres
  Room<std::int32_t, 8> ids_;                 ///< per octant: a list with room for all triangles
  std::array<std::int32_t, 8> nearest_;       ///< the triangle nearest to each octant's centre
  std::array<double, 8> distances_;
  std::array<NearTriangles, 8> near_;
};

}  // namespace sdf_ccd
