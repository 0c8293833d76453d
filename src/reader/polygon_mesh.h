#pragma once

#include <cstdint>
#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Polygons of a file, whose vertices may be read later.
class PolygonList {
 public:
  /// Adds a polygon. Polygons of fewer than three corners (points and lines) are ignored.
  /// @param corners  vertex indices; checked by appendTo().
  /// @throws std::runtime_error if there are more corners than a polygon may have.
  void add(const std::vector<std::int64_t>& corners);

  /// Triangulates the polygons and appends the triangles to a mesh that already has the vertices.
  /// @throws std::runtime_error for an index without a vertex.
  void appendTo(TriangleMesh& mesh) const;

 private:
  std::vector<std::int64_t> corners_;  // of all polygons, concatenated
  std::vector<std::size_t> ends_;
};

}  // namespace sdf_ccd
