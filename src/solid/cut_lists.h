#pragma once

#include <cstddef>
#include <vector>

#include "mesh/triangle_tree.h"
#include "surface_tolerance.h"

namespace sdf_ccd {

/// Per triangle, those that cut it, overlap it or touch it elsewhere than at shared vertices and edges, within the
/// tolerance of a layer; conservative. Only triangles with a certain plane have lists.
struct CutLists {
  std::vector<std::vector<int>> of;  ///< ascending
  std::size_t pairs = 0;             ///< entries of all lists
  bool complete = true;              ///< false: there are more than `max_pairs`; lists hold only their first entries
};

/// @param tree  over the same mesh.
CutLists cutLists(const TriangleMesh& mesh, const TriangleTree& tree, const SurfaceTolerance& tolerance,
                  std::size_t max_pairs);

}  // namespace sdf_ccd
