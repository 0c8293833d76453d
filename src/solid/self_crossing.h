#pragma once

#include "mesh/triangle_tree.h"

namespace sdf_ccd {

/// Whether more than two triangles of a mesh meet in an edge.
bool branches(const TriangleMesh& mesh);

/// Whether a closed surface may enclose regions where its winding number is zero: where it crosses itself, a solid part
/// and a lobe that is inside out may overlap and cancel each other. Such a region has a piece of the crossing on its
/// border. So beside all crossings, each point where the number is zero is tested for whether it sees the outside;
/// conservative. Regions thinner than 1e-5 of the mesh's size may be missed.
/// @param tree  over the same mesh.
bool mayHidePockets(const TriangleMesh& mesh, const TriangleTree& tree);

}  // namespace sdf_ccd
