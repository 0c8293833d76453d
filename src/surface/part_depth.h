#pragma once

#include <vector>

#include "common/infinity.h"
#include "sdf_ccd/field.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd {

/// One element of the body in which depths are measured. G is the element's frame, B the body's.
struct SolidPart {
  Isometry3d X_GB;
  const DistanceField* field;  ///< gives bounds, so that fewer exact distances are computed
  const Solid* solid;          ///< of a closed mesh; null for a primitive, which is convex and whose field is exact
};

/// The depth of one point [m].
struct PartDepth {
  double depth = -kInfinity;
  int triangle = -1;                ///< the nearest one; -1 for a primitive
  Vector3d out = Vector3d::Zero();  ///< outward normal: unit, or zero where there is none
};

/// Whether a point is in an element that has a solid; in the element's frame.
bool isInside(const SolidPart& part, const Vector3d& p_G);

/// In the element's frame.
PartDepth depthIn(const SolidPart& part, const Vector3d& p_G);

/// The largest of a point's depths in all elements, in the body's frame.
PartDepth depthIn(const std::vector<SolidPart>& solid, const Vector3d& p);

}  // namespace sdf_ccd
