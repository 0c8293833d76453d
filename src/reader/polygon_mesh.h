#pragma once

#include <cstdint>
#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// The polygons of a file, whose vertices may be known only later.
class PolygonList {
 public:
  /// @param corners  indices of vertices. Fewer than three are left out: points and lines.
  void add(const std::vector<std::int64_t>& corners);

  /// Appends their triangles to a mesh that has the vertices.
  /// @throws std::runtime_error for an index that is none, and for more corners than a polygon may have.
  void appendTo(TriangleMesh& mesh) const;

 private:
  std::vector<std::int64_t> corners_;  // of all, one after the other
  std::vector<std::size_t> ends_;
};

/// A vertex of a text file. Rounded to float as rviz draws it, so that corners which differ by their last digit are
/// one.
inline Vector3d vertexOf(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

}  // namespace sdf_ccd
