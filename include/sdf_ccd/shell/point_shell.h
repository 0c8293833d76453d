#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// Points on a body's surface, in its frame P.
struct PointShell {
  std::vector<Vector3d> points;   ///< [m]
  std::vector<Vector3f> normals;  ///< unit, pointing out
  std::vector<float> areas;       ///< surface area that each point represents [m²]
  double covering_radius = 0.0;   ///< upper bound of the distance from the surface's locations to the points [m]

  /// The same for the edges of its flat pieces, which deviate from planes by `flatness` [m]; see contact_gap.h.
  /// Infinite if edges have not been sampled separately.
  double edge_radius = std::numeric_limits<double>::infinity();
  double flatness = 0.0;

  std::size_t size() const { return points.size(); }
};

/// Bounding spheres over the points of a shell (paper §3.3), nested: each node's sphere holds all points below it.
struct SphereTree {
  struct Node {
    Vector3d center;     ///< [m], frame P
    double radius;       ///< [m]
    std::int32_t begin;  ///< points [begin, end) of the shell lie below this node
    std::int32_t end;
    std::int32_t first_child;  ///< children are consecutive; -1 for a leaf
    std::int32_t child_count;
  };
  /// Root first, level by level: children of neighbours are neighbours too. Empty for an empty shell.
  std::vector<Node> nodes;
};

/// Builds the tree; the shell's points (and normals and areas) are reordered so that every node's are consecutive.
SphereTree buildSphereTree(PointShell& shell);

/// Writes a point shell, as saveField() does a field.
/// @throws std::runtime_error naming the path and the reason, also if loadShell() would refuse the shell.
void saveShell(const PointShell& shell, const std::string& path, const std::string& key = {});

/// Reads a shell file, as loadField().
/// @throws std::runtime_error naming the path and what is wrong with the file.
PointShell loadShell(const std::string& path, const std::string& key = {});

}  // namespace sdf_ccd
