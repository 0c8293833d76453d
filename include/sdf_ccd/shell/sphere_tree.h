#pragma once

#include <cstdint>
#include <vector>

#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

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

}  // namespace sdf_ccd
