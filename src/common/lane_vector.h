#pragma once

#include <array>

#include "common/compiler_lanes.h"

namespace sdf_ccd::lanes {

/// Three coordinates in each lane of compiler_lanes.h. (Vectors of Highway are in query/lanes.)
template <class Lanes>
struct LaneVector {
  Lanes x, y, z;

  SDF_CCD_INLINE LaneVector operator+(const LaneVector& o) const { return {x + o.x, y + o.y, z + o.z}; }
  SDF_CCD_INLINE LaneVector operator-(const LaneVector& o) const { return {x - o.x, y - o.y, z - o.z}; }
  SDF_CCD_INLINE LaneVector operator*(const Lanes& s) const { return {x * s, y * s, z * s}; }
  SDF_CCD_INLINE Lanes dot(const LaneVector& o) const { return x * o.x + y * o.y + z * o.z; }
  template <class Number>
  SDF_CCD_INLINE Lanes dot(const std::array<Number, 3>& o) const {
    return x * o[0] + y * o[1] + z * o[2];
  }
  SDF_CCD_INLINE LaneVector cross(const LaneVector& o) const {
    return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
  }
};

/// Vectors in memory, a number a lane.
using VectorsInMemory = std::array<std::array<double, kWidth>, 3>;

SDF_CCD_INLINE LaneVector<Doubles> load(const VectorsInMemory& from) {
  return {load(from[0].data()), load(from[1].data()), load(from[2].data())};
}

SDF_CCD_INLINE void store(const LaneVector<Doubles>& v, VectorsInMemory& to) {
  store(v.x, to[0].data());
  store(v.y, to[1].data());
  store(v.z, to[2].data());
}

}  // namespace sdf_ccd::lanes
