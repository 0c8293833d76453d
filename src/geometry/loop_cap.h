#pragma once

#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Triangles within a closed loop of places, of small area together.
struct LoopCap {
  std::vector<Vector3i> triangles;  ///< of the loop's vertices, along its direction
  double area = 0.0;                ///< [m²]
};

/// The smallest of all triangulations (Barequet & Sharir 1995) of a loop of up to 100 vertices; of longer ones, ears
/// are cut off before, the smallest first (Visvalingam & Whyatt 1993), until so many are left.
/// @param loop  indices into `vertices`; may pass a vertex more than once.
LoopCap capLoop(const std::vector<Vector3d>& vertices, const std::vector<int>& loop);

/// Caps for all loops. Two of them that lie along each other share one where its area is smaller: they are run through
/// as one loop, over a bridge there and back.
std::vector<LoopCap> capLoops(const std::vector<Vector3d>& vertices, const std::vector<std::vector<int>>& loops);

}  // namespace sdf_ccd
