#pragma once

#include <memory>
#include <vector>

#include "mesh/mesh_patches.h"
#include "mesh/triangle_tree.h"

namespace sdf_ccd {

/// Properties of one patch.
struct MeasuredPatch {
  std::unique_ptr<TriangleTree> tree;  ///< null if the patch is open, or encloses no volume
  AlignedBox3d box;
  bool inward = false;                  ///< from outside, mostly its back is visible
  int negative_triangles = 0;           ///< as seen from outside, they face the other way than most
  Vector3d witness = Vector3d::Zero();  ///< a point on its surface
  Vector3d behind = Vector3d::Zero();   ///< a point just behind the witness
};

MeasuredPatch measurePatch(const TriangleMesh& mesh, const Patch& patch);

}  // namespace sdf_ccd
