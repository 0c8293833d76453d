#pragma once

#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Triangles that fill a closed loop of points, of small total area.
struct LoopCap {
  std::vector<Vector3i> triangles;  ///< of the loop's vertices, along its direction
  double area = 0.0;                ///< [m²]
};

/// The smallest of all triangulations (Barequet & Sharir 1995) of a loop of up to 100 vertices. From longer ones, ears
/// are cut off first, the smallest first (Visvalingam & Whyatt 1993), until 100 vertices are left.
/// @param loop  indices into `vertices`; may pass a vertex more than once.
LoopCap capLoop(const std::vector<Vector3d>& vertices, const std::vector<int>& loop);

/// Caps for all loops. Two loops that run along each other share a cap if its area is smaller: they are joined to one
/// loop by a bridge that is passed in both directions.
std::vector<LoopCap> capLoops(const std::vector<Vector3d>& vertices, const std::vector<std::vector<int>>& loops);

}  // namespace sdf_ccd
