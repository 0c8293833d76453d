#pragma once

#include <memory>
#include <vector>

#include "geometry/trees/triangle_tree.h"
#include "mesh_patches.h"

namespace sdf_ccd {

/// Properties of one patch.
struct MeasuredPatch {
  std::unique_ptr<TriangleTree> tree;  ///< null if the patch is open, or encloses no volume
  AlignedBox3d box;
  bool inward = false;                   ///< from outside, mostly its back is visible
  std::vector<std::int32_t> facing_out;  ///< triangles of the mesh with a winding number above zero behind them
  std::vector<std::int32_t> facing_in;   ///< all others
  Vector3d witness = Vector3d::Zero();   ///< a point on its surface
  Vector3d behind = Vector3d::Zero();    ///< a point just behind the witness
  double own_number = 0.0;               ///< the patch's winding number at `behind`
  bool flat = false;                     ///< a sheet that is drawn from both sides
  bool unmeasured = false;               ///< its volume is zero, but it is not flat
};

MeasuredPatch measurePatch(const TriangleMesh& mesh, const Patch& patch);

}  // namespace sdf_ccd
